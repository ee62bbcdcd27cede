// What a block asks of the flow of the program: stops, ends, calls of subprograms.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/block_flow.hpp"
#include "parser/interpret/filters/motion_filters.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Result<Flow> finish(InterpreterState& state, MotionFilters& filters,
                                  const BlockWords& words);

// The program ends without a word that says so.
[[nodiscard]] Outcome finish_text(InterpreterState& state, MotionFilters& filters);

}  // namespace frustum::parser
