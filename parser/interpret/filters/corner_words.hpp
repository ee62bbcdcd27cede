// RND and CHF of Klartext in a block: their words, and what may be between them and the moves
// that they join.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/filters/motion_filters.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome insert_corner(InterpreterState& state, MotionFilters& filters,
                                    const BlockWords& words);

// ,R and ,C of the block, when its move is made.
[[nodiscard]] Outcome keep_corner(InterpreterState& state, MotionFilters& filters,
                                  const BlockWords& words);

}  // namespace frustum::parser
