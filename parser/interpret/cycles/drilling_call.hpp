// Drilling cycles at the place where the tool is, called once or, by MCALL, after each block that
// moves.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// A block that has a cycle defines it, or makes the hole; with MCALL it is in force until MCALL
// alone.
[[nodiscard]] Outcome call_drilling_cycle(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
