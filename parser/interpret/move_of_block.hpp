// The move of a block, by its non-modal word or its motion word.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome make_move(InterpreterState& state, const BlockWords& words,
                                const Movement& movement);

}  // namespace frustum::parser
