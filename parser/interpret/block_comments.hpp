// What a block says without moving anything: comments, messages, words that are only events.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

void report_comments(InterpreterState& state, const Block& block);
void report_events(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
