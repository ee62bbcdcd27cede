// The words that shift, turn, scale and mirror the frame of the words that follow: G92, G52, G68,
// G51, G51.1.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

// The tool stays where it is; its coordinates change.
void change_programmed_frame(InterpreterState& state, const ProgrammedFrame& next);
[[nodiscard]] Outcome shift_words(InterpreterState& state, const BlockWords& words, NonModal how);
// What Fanuc has no place for within G68, G51 and G51.1: reference points, other frames, planes.
[[nodiscard]] Outcome check_frame_words(const InterpreterState& state, const BlockWords& words);
// G68: about the centre X Y (of the plane's axes) by R degrees.
[[nodiscard]] Outcome turn_words(InterpreterState& state, const BlockWords& words);
// G51 X Y Z P: lengths times P about a centre.
[[nodiscard]] Outcome set_scaling(InterpreterState& state, const BlockWords& words);
// G51.1 X10: what is beyond X10 is on this side of it.
[[nodiscard]] Outcome set_mirror(InterpreterState& state, const BlockWords& words);
// A turned frame mixes the axes, so that all of them have to be known before one of them moves.
[[nodiscard]] Outcome check_programmed_frame(const InterpreterState& state,
                                             const Movement& movement);

}  // namespace frustum::parser
