// RND= CHF= CHR= RNDM= of Sinumerik in the block of a move: the corner at its end.
//
// Units : mm, mm/min
// Errors: a size below zero, two corners at once, compensation that changes between a corner and
//         the move after it; those of corner_insertion.hpp
#pragma once

#include "parser/interpret/filters/motion_filters.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// Before the move of the block: whether motions wait for a corner from here on.
[[nodiscard]] Outcome look_for_corner(InterpreterState& state, MotionFilters& filters,
                                      const BlockWords& words);
// After it: the corner that the block asks for.
[[nodiscard]] Outcome ask_for_corner(InterpreterState& state, MotionFilters& filters,
                                     const BlockWords& words);

}  // namespace frustum::parser
