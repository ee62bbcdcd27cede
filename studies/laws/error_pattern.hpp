// Patterns that name terms of errors: "E?X:harmonic 2", "ECB", "E*C:reversal".
//
// Model    : an error's name, * for any letters and ? for one, then perhaps a colon, a kind of
//            shape and the order of a harmonic. The name is an ISO name; an alias is read as the
//            error that it stands for, or by its own name
// Units    : none
// Errors   : a kind or an order that does not exist
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "kinematics/errors/error_shape.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::studies {

struct ErrorPattern {
  std::string name{};
  std::optional<kinematics::ErrorShape::Kind> kind{};
  std::optional<int> order{};

  [[nodiscard]] static Result<ErrorPattern> parse(std::string_view text);
  [[nodiscard]] bool matches(std::string_view error, const kinematics::ErrorShape& shape) const;
};

// Whether the text is the pattern's, * and ? read as above.
[[nodiscard]] bool matches_wildcards(std::string_view pattern, std::string_view text);
// The ISO name of an entry's error: that of an alias where it is one.
[[nodiscard]] std::string iso_name(const kinematics::Machine& machine, const std::string& name);

}  // namespace frustum::studies
