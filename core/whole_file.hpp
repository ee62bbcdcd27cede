// Files as a whole: read, and written whole or not at all.
//
// The house reads files here, but for NC programs, which are read line by line (parser/reading).
// What is written goes to a new file beside the target, which is then renamed over it, so that an
// existing file is untouched until the new one is complete, and a failure leaves nothing behind.
// Devices and pipes (/dev/stdout) are written as they are. What was read is not written over.
// Units: none. Errors: a diagnostic that names the file when it cannot be read or written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "core/result.hpp"

namespace frustum {

// All bytes of a file; a folder is none. What is no regular file (a pipe, a device) is read to its
// end, which is an error when it does not come within 256 MiB.
[[nodiscard]] Result<std::string> read_whole_file(const std::filesystem::path& path);
// The same of a file that is to be replaced by what this process writes (core/files_read.hpp).
[[nodiscard]] Result<std::string> read_to_replace(const std::filesystem::path& path);

// The folder must exist. Returns the path.
[[nodiscard]] Result<std::filesystem::path> write_whole_file(const std::filesystem::path& path,
                                                             std::string_view bytes);
// The same, and on the disk when it returns: whatever happens to the machine afterwards, the file
// is there as a whole.
[[nodiscard]] Result<std::filesystem::path> write_synced_file(const std::filesystem::path& path,
                                                              std::string_view bytes);
// Why it would fail, as far as can be known before the work: no folder, or none to write to.
[[nodiscard]] std::optional<Diagnostic> unwritable(const std::filesystem::path& path);
// What "the file cannot be written" looks like everywhere.
[[nodiscard]] Diagnostic cannot_write(const std::filesystem::path& path, std::string_view reason);

}  // namespace frustum
