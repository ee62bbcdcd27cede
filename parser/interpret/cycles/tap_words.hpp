// The words of CYCLE84 and CYCLE840 of Sinumerik beside their heights: the lead and its hand, the
// strokes, how the spindle turns on the way back, and whether the axis follows it.
//
// Units : mm, 1/min
// Errors: the first one of the block, with line, column and hint
// Source: SINUMERIK 840D, programming guide of the cycles, 11.2002, CYCLE84 and CYCLE840
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/drilling_cycle.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_tap(const InterpreterState& state, const BlockWords& words,
                              DrillingCycle& cycle);
// CYCLE840: in a floating chuck.
[[nodiscard]] Outcome set_floating_tap(InterpreterState& state, const BlockWords& words,
                                       DrillingCycle& cycle);

}  // namespace frustum::parser
