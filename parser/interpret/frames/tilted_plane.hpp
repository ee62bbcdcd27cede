// Tilted planes: swivels and their end, the plane in force, the axes turned to its normal.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <cstdint>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_tilted_plane(InterpreterState& state, const BlockWords& words);
[[nodiscard]] Outcome align(InterpreterState& state, std::uint32_t column);
// TURN and MOVE; STAY leaves the axes where they are. MOVE holds the tip, as tool-tip control does.
[[nodiscard]] Outcome turn_to_plane(InterpreterState& state, const BlockWords& words);
// The plane is in the frame of the words at work, which is that of the words again after G69.
[[nodiscard]] Outcome tilt(InterpreterState& state, const GivenCode& code, const Pose& plane,
                           bool within);

}  // namespace frustum::parser
