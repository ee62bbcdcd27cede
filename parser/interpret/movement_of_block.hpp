// What of a block moves axes, and how; which words belong to that.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] MotionMode motion_of(const InterpreterState& state, const BlockWords& words);
[[nodiscard]] Result<Movement> movement_of(const InterpreterState& state, const BlockWords& words);
// The words that nothing in the block uses, where they may be there all the same: beside a word of
// the machine's builder, or idle.
[[nodiscard]] Result<LetterSet> check_claims(const InterpreterState& state, const BlockWords& words,
                                             const Movement& movement);

}  // namespace frustum::parser
