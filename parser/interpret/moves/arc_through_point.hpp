// Arcs in space, as chords: through a point between start and end (CIP of Sinumerik, which stays an
// arc in a plane of X, Y and Z), and about an axis u v w at the centre I J K (CIRCLE of CLDATA).
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
[[nodiscard]] Outcome move_about_axis(InterpreterState& state, const BlockWords& words,
                                      const Movement& movement);

}  // namespace frustum::parser
