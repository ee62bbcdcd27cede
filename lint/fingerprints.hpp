// Marks by which findings are known again when lines move.
//
// A mark is of the check and the text of the line, without block number and blanks; or, where a
// finding stands for several lines, of what they have in common: M250, a feed. No line number is
// part of it.
// Units : none
// Errors: none
#pragma once

#include <span>
#include <string>
#include <vector>

#include "lint/finding_list.hpp"
#include "lint/source_lines.hpp"

namespace frustum::lint {

// "1a2b3c4d5e6f7081"
[[nodiscard]] std::string fingerprint_of(const Finding& finding, const SourceLines& lines);
// "1a2b3c4d5e6f7081:1", one for each finding: those of a file that are alike are numbered.
[[nodiscard]] std::vector<std::string> fingerprints_of(std::span<const Finding> findings,
                                                       const SourceLines& lines);

}  // namespace frustum::lint
