// Holes of a canned cycle on a circle, an arc or a line about where the tool is: G70, G71 and G72
// beside I and L of Haas.
//
// Model : G70 I J L: L holes evenly on the circle of radius I, the first at the angle J; G71 I J K
//         L: each K further on; G72 I J L: I apart on the line by J, the first where the tool is
// Units : mm; from where the tool is, along the two axes of the plane
// Errors: a word that is missing, too many holes
// Source: Haas Mill Operator's Manual (NGC, 2017), G70 to G72; angles are counterclockwise from +X
#pragma once

#include <vector>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// None where the block has no such word.
[[nodiscard]] Result<std::vector<Vec2>> bolt_places(InterpreterState& state,
                                                    const BlockWords& words);

}  // namespace frustum::parser
