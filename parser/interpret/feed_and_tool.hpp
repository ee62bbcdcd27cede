// Feed, tool, spindle, coolant and dwell: what neither moves an axis nor changes a frame.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_feed(InterpreterState& state, const BlockWords& words);
[[nodiscard]] Outcome set_tool(InterpreterState& state, const BlockWords& words);
void set_spindle_and_coolant(InterpreterState& state, const BlockWords& words, bool speed);
[[nodiscard]] Outcome dwell(InterpreterState& state, const BlockWords& words);

// S, if it `counts` and is not the time of a dwell; whether it is a new speed of the spindle.
[[nodiscard]] Result<bool> set_speed(InterpreterState& state, const BlockWords& words, bool counts);

}  // namespace frustum::parser
