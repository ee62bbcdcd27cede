// What a block says without moving anything: comments, messages, words that are only events.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// A comment may end the program: (ABORT, text).
[[nodiscard]] Outcome report_comments(InterpreterState& state, const Block& block);
// `idle` are the words that nothing else in the block uses.
void report_events(InterpreterState& state, const BlockWords& words, LetterSet idle = {});

}  // namespace frustum::parser
