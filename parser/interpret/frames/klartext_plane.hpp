// PLANE of Klartext: tilted planes by angles, vectors, points, and on top of each other. The datum
// stays.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_plane(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
