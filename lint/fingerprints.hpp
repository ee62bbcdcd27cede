// Marks by which findings are known again when lines move.
//
// A mark is of the check, the file and the text of the line, without block number and blanks; what
// has the same three is numbered in its order. The message is no part of it, nor a line number.
// Units : none
// Errors: none
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lint/finding_list.hpp"
#include "lint/source_lines.hpp"

namespace frustum::lint {

// "1a2b3c4d5e6f7081:1", one for each finding: check and line alone, numbered within each file.
[[nodiscard]] std::vector<std::string> fingerprints_of(std::span<const Finding> findings,
                                                       const SourceLines& lines);

}  // namespace frustum::lint
