// Numbers without a decimal point: as the setting of the control has them.
//
// Units : as written; increments are 0.001 mm, 0.0001 inch, 0.001 degrees, 0.001 s, and of a feed
//         1 mm/min, 0.01 inch/min, 0.01 mm, 0.0001 inch
// Errors: none; a word that the settings could make another place of is an event
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// Before any word of the block is looked at; `unit` is the one after it.
void count_without_points(InterpreterState& state, BlockWords& words, LengthUnit unit);

}  // namespace frustum::parser
