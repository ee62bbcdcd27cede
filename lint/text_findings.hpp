// Findings for people, as compilers write them:
//
//   part.nc:12:4: error: G1 without a feed rate [feed-missing]
//      12 | N40 G1 X10
//         |     ^
//         = give F on this block or before, above zero
//
// Units : columns count bytes
// Errors: none
#pragma once

#include <string>

#include "lint/program_check.hpp"
#include "lint/source_lines.hpp"

namespace frustum::lint {

// Ends with a line that counts the findings.
[[nodiscard]] std::string text_of(const CheckReport& report, const SourceLines& lines);

}  // namespace frustum::lint
