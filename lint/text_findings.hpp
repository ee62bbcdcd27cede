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

#include <span>
#include <string>

#include "lint/checked_file.hpp"

namespace frustum::lint {

// What is suppressed is left out.
[[nodiscard]] std::string text_of(const CheckedFile& checked);
// "1 error, 0 warnings, 2 notes in 40 blocks that ran, 3 programs": the last line.
[[nodiscard]] std::string summary_of(std::span<const CheckedFile> checked);

}  // namespace frustum::lint
