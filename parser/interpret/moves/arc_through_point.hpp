// Arcs through a point between start and end: CIP of Sinumerik. In a plane of X, Y and Z they stay
// arcs; in space they become chords.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome move_through_point(InterpreterState& state, const BlockWords& words,
                                         const Movement& movement);

}  // namespace frustum::parser
