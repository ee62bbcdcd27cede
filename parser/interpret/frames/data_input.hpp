// G10: what a program writes into the control's data, by its L word.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_data(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
