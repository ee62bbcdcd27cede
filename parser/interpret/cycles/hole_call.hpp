// Hole cycles in a program: their definition, and one hole.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <string>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_hole_cycle(InterpreterState& state, const BlockWords& words);
void set_called_program(InterpreterState& state, std::string name);
// The words name the top of the hole; the tool comes from where it is, over the hole and down.
[[nodiscard]] Outcome make_hole(InterpreterState& state, const BlockWords& words,
                                const Movement& movement);
// CYCL CALL, M99: at the place where the tool is.
[[nodiscard]] Outcome call_hole_cycle(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
