// The words of a move: the end, the tool vector, the feed.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_start(InterpreterState& state, const BlockWords& words);
[[nodiscard]] Outcome check_tool_length(const InterpreterState& state, const Movement& movement);
[[nodiscard]] Outcome set_target(InterpreterState& state, const BlockWords& words, AxisLetter axis);
[[nodiscard]] Outcome set_targets(InterpreterState& state, const BlockWords& words);
[[nodiscard]] Outcome set_tool_axis(InterpreterState& state, const BlockWords& words);
[[nodiscard]] Result<Feed> feed_for(InterpreterState& state, const BlockWords& words,
                                    const Movement& movement, bool linear);

}  // namespace frustum::parser
