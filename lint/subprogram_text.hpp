// Whether a text is a subprogram, which others call, by what it says itself.
//
// One is a file of Sinumerik whose name ends in .spf or whose text begins with PROC or a head of
// that kind; one whose last block is M99, M17 or RET, without M30 or M2 anywhere; one of LinuxCNC
// with nothing outside of sub and endsub but an end.
// Units : none
// Shape : reads the text once
// Errors: none; lines that cannot be read say nothing
#pragma once

#include "parser/program.hpp"

namespace frustum::lint {

[[nodiscard]] bool is_subprogram(const parser::Program& program);

}  // namespace frustum::lint
