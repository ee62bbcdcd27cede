// Places by radius and angle: @ and ^ of LinuxCNC, G16 of Fanuc.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// @ radius and ^ angle about the origin, in the plane; what is not given stays as it is.
[[nodiscard]] Outcome set_polar_target(InterpreterState& state, const BlockWords& words);
// The words of the plane's two axes. In G16 the first is a radius, the second an angle.
[[nodiscard]] Outcome set_place_in_plane(InterpreterState& state, const BlockWords& words);
void set_polar_mode(InterpreterState& state, const BlockWords& words);
[[nodiscard]] Outcome check_polar_arc(const InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
