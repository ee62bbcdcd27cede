// Tilted planes of Fanuc: G68.2 and G68.4 in all their forms, G68 about an axis in space.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_feature(InterpreterState& state, const BlockWords& words);
[[nodiscard]] Outcome check_feature(const InterpreterState& state, const Movement& movement);
// G68 X Y Z I J K R: about the axis I J K through X Y Z, which becomes the origin.
[[nodiscard]] Outcome turn_in_space(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
