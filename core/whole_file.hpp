// Writing a finished file: whole or not at all.
//
// The bytes go to a new file beside the target, which is then renamed over it, so that an existing
// file is untouched until the new one is complete, and a failure leaves nothing behind.
// Units: none. Errors: a diagnostic that names the file and the reason when it cannot be written.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.hpp"

namespace frustum {

// The folder must exist. Returns the path.
[[nodiscard]] Result<std::filesystem::path> write_whole_file(const std::filesystem::path& path,
                                                             std::string_view bytes);
// What "the file cannot be written" looks like everywhere.
[[nodiscard]] Diagnostic cannot_write(const std::filesystem::path& path, std::string_view reason);

}  // namespace frustum
