// What a program's motions leave open: words of the machine's builder, and what was taken for
// granted where a control decides by its parameters.
//
// Units : none
// Errors: none; each doubt is a warning with file, line and column (file: of a subprogram alone)
#pragma once

#include <vector>

#include "core/diagnostic.hpp"
#include "parser/motion.hpp"

namespace frustum::parser {

// Each name once, where it is first.
[[nodiscard]] Diagnostics doubts_of(const std::vector<Motion>& motions);

}  // namespace frustum::parser
