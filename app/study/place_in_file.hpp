// A problem that is found after a file was read, at the line of the key that is to blame.
//
// Units  : none
// Errors : nothing where the file does not have the key: the problem comes from elsewhere
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace frustum::app {

// Of the root, or of the table of that name.
[[nodiscard]] std::optional<Diagnostic> at_key(const std::filesystem::path& file,
                                               std::string_view table, std::string_view key,
                                               const Diagnostic& problem);
// Of the table in the list [[list]] with name = `name`.
[[nodiscard]] std::optional<Diagnostic> at_key_of(const std::filesystem::path& file,
                                                  std::string_view list, const std::string& name,
                                                  std::string_view key, const Diagnostic& problem);

}  // namespace frustum::app
