// The NC programs among files and folders.
//
// A file that is named is a program. In folders, and in those within, programs are files whose
// name has an ending of programs (nc, ngc, tap, mpf, apt, ...), whatever is in them, and files of
// other endings or none whose text reads as one. Names that begin with a dot are left out, links
// to folders are not followed.
// Units : none
// Errors: what cannot be read, each by its name: it may be a program
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostic.hpp"

namespace frustum::app {

// Whether the text reads as a program: nearly all of its first lines are blocks of its dialect, and
// one of them commands something.
[[nodiscard]] bool reads_as_program(std::string_view text, const std::string& file);

struct FolderOptions {
  std::vector<std::string> endings{};  // further ones of programs ("prg")
  // Files and folders that are not looked at; none where it is empty.
  std::function<bool(const std::filesystem::path&)> excluded{};
};
struct FolderPrograms {
  std::vector<std::string> files{};  // in the order of their names
  std::size_t excluded = 0;
  Diagnostics troubles{};
};
[[nodiscard]] FolderPrograms programs_in(const std::filesystem::path& folder,
                                         const FolderOptions& options);

// The same for all spellings of a file; that of the standard input is "-".
[[nodiscard]] std::string whole_name(const std::string& file);
// Also through links; not the standard input, nor an empty name.
[[nodiscard]] bool is_same_file(const std::string& one, const std::string& other);

// Whether a pattern (* ? [..]) is that of the name of the file or of a folder on the way to it; or,
// where it has a / within, of the path of one of them from `folder`.
[[nodiscard]] bool is_excluded(const std::filesystem::path& file,
                               const std::vector<std::string>& patterns,
                               const std::filesystem::path& folder);

}  // namespace frustum::app
