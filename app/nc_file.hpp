// NC programs and CLDATA as files.
//
// Units    : those of parser/motion.hpp
// Errors   : what cannot be read or understood, with file, line and column
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "parser/motion.hpp"

namespace frustum::app {

// `dialect` as --dialect writes it; empty: recognised.
[[nodiscard]] Result<std::vector<parser::Motion>> motions_of_file(const std::string& file,
                                                                  const std::string& dialect);

// A name that controllers take, from a file's: letters, digits and _.
[[nodiscard]] std::string program_name(const std::filesystem::path& file);

// Diagnostics with a line but no file get this one.
[[nodiscard]] Diagnostics in_file(Diagnostics diagnostics, const std::string& file);

}  // namespace frustum::app
