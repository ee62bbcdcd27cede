// Modes that a program or a call keeps and brings back: M70 to M73, SAVE, the ends of calls.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome keep_modes(InterpreterState& state, const BlockWords& words);
void enter_call(InterpreterState& state);
void leave_call(InterpreterState& state);

// The modes of G words and the frame come back at the end of the call at work (SAVE).
void keep_modes_for_call(InterpreterState& state);

}  // namespace frustum::parser
