// The NC programs among files and folders.
//
// A file that is named is a program. In folders, and in those within, programs are files whose
// name has an ending of programs (nc, ngc, tap, mpf, apt, ...), and files of other endings or none
// whose text reads as one; names that begin with a dot are left out.
// Units : none
// Errors: what does not exist or cannot be read
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"

namespace frustum::app {

// Whether the text reads as a program: nearly all of its first lines are blocks of its dialect.
[[nodiscard]] bool reads_as_program(std::string_view text, const std::string& file);

// Programs of a folder, in the order of their names. `endings`: further ones of programs ("prg").
[[nodiscard]] Result<std::vector<std::string>> programs_in(const std::filesystem::path& folder,
                                                           const std::vector<std::string>& endings);

// Whether a pattern (* ? [..]) is that of the file's name, or of its path from `folder`.
[[nodiscard]] bool is_excluded(const std::string& file, const std::vector<std::string>& patterns,
                               const std::filesystem::path& folder);

}  // namespace frustum::app
