// Units of length as point files state them, and the unit that a wrong size betrays.
//
// Model    : a file whose numbers are in another unit than mm is off by the unit's whole factor,
//            which no real part is: sizes are compared with the planned ones by ratio
// Units    : mm per unit
// Shape    : a few words; one size
// Errors   : stated_unit refuses words after "unit:" that name no length
// Accuracy : likely_unit asks for a ratio within 1.5 of the unit's own
// Source   : ours
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace frustum::metrology {

struct LengthUnit {
  std::string name{};
  double mm = 1.0;

  bool operator==(const LengthUnit&) const = default;
};

// mm um nm m cm in, and their names in words, upper or lower case.
[[nodiscard]] std::optional<LengthUnit> length_unit(std::string_view name);

// What a comment says about the unit: "unit: inch", "units = um", or a comment that is but "mm" or
// "inch".
[[nodiscard]] Result<std::optional<LengthUnit>> stated_unit(std::string_view comment);

// A column heading and the unit in it: "x [inch]", "X(mm)", "x [\"]", "y_um". In lower case; unit
// may be empty.
struct NameWithUnit {
  std::string name{};
  std::string unit{};
};
[[nodiscard]] NameWithUnit name_with_unit(std::string_view text);

// What a file states against what the caller says.
[[nodiscard]] Diagnostic unlike_units(const LengthUnit& stated, const LengthUnit& asked);

// The unit that numbers seem to be in when they span `size` where `expected` mm were planned;
// nothing when mm will do, or no unit would.
[[nodiscard]] std::optional<LengthUnit> likely_unit(double size, double expected);

}  // namespace frustum::metrology
