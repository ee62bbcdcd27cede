// The points of PATTERN DEF of Klartext, at which CYCL CALL PAT calls the cycle in force.
//
// Model : language/point_pattern.hpp; one element after the other, the lines of PAT to and fro, the
//         border of FRAME round from its first point along X
// Units : mm; X and Y in the frame of the words, Z how much higher the surface is there
// Errors: a number of points that is none, too many, a value that only the machine knows
#pragma once

#include <vector>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// Of a block that has PATTERN DEF.
[[nodiscard]] Outcome set_point_pattern(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
