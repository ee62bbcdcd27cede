// APPR and DEP in a program: their words, and what may not happen while an approach waits for its
// contour.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/filters/motion_filters.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome check_approach(const InterpreterState& state, const MotionFilters& filters,
                                     const BlockWords& words);
// After the frames and the radius compensation of the block.
[[nodiscard]] Outcome approach_or_leave_contour(InterpreterState& state, MotionFilters& filters,
                                                const BlockWords& words);
// Where the text ends.
[[nodiscard]] Outcome check_approach_at_end(const MotionFilters& filters);

}  // namespace frustum::parser
