// Writing a finished text to a file.
//
// Units: none. Errors: a diagnostic that names the file and the reason when it cannot be written.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.hpp"

namespace frustum::report {

// What "the file cannot be written" looks like in every writer of this room.
[[nodiscard]] Diagnostic cannot_write(const std::filesystem::path& path, std::string_view reason);

// Writes (and replaces) the file; the folder must exist. Returns the path.
[[nodiscard]] Result<std::filesystem::path> write_text_file(const std::filesystem::path& path,
                                                            std::string_view text);

}  // namespace frustum::report
