// Which files this process has read: none of them is replaced by what it writes.
//
// A program says at its start that it wants this; a library in a process of others does not, since
// there a file may well be read at one time and written at another.
// Units  : none
// Errors : a diagnostic that names the file that would be lost
// Threads: any
#pragma once

#include <filesystem>
#include <optional>

#include "core/diagnostic.hpp"

namespace frustum {

// From here on files that are read are remembered: as files, whatever names and links they have.
// With false they are forgotten.
void keep_what_is_read(bool kept = true);
// Those that read files say so. What is read in order to be replaced is not noted.
void note_read(const std::filesystem::path& file);
// Why this must not be written to: it has been read.
[[nodiscard]] std::optional<Diagnostic> would_be_lost(const std::filesystem::path& file);

}  // namespace frustum
