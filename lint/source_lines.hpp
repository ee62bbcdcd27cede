// The lines of a program that findings point at.
//
// Units : lines and columns from 1
// Shape : each file is read once, up to the last line that is wanted
// Errors: none; a file that cannot be read gives no lines
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>

#include "lint/finding_list.hpp"
#include "parser/program.hpp"

namespace frustum::lint {

using SourceLines = std::map<std::pair<std::string, std::uint32_t>, std::string>;  // file, line

[[nodiscard]] SourceLines source_lines(const parser::Program& program,
                                       std::span<const Finding> findings);

}  // namespace frustum::lint
