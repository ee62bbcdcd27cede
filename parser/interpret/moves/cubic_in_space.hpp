// A cubic (Bezier) curve in space, as lines: from where the tool is, by the control points I J K
// and u v w to the end (a part of NURBS of CLDATA).
//
// Units   : mm, mm/min
// Errors  : the first one of the block, with line, column and hint
// Accuracy: 0.0001 mm between the curve and the lines
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome move_along_cubic_in_space(InterpreterState& state, const BlockWords& words,
                                                const Movement& movement);

}  // namespace frustum::parser
