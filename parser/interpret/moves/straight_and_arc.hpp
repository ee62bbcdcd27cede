// Straight moves and arcs in the plane.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome move_straight(InterpreterState& state, const BlockWords& words,
                                    const Movement& movement);
[[nodiscard]] Outcome move_along_arc(InterpreterState& state, const BlockWords& words,
                                     const Movement& movement);

}  // namespace frustum::parser
