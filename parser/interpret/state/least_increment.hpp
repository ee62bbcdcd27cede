// The least increment of an address, to which Fanuc rounds what the program computes: the value of
// the word, and ROUND within its expression.
//
// Units : as written
// Errors: none
// Source: Haas 96-8000, Macros: Address Substitution, ROUND in an address expression
#pragma once

#include "parser/dialect.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// Steps in a unit: 1000 of mm and degrees, 10,000 of inches, 1 of what counts in whole numbers.
[[nodiscard]] double steps_of_unit(Dialect dialect, char letter, LengthUnit unit);

// The words of the block that are lengths and angles and that an expression gives.
void round_computed(InterpreterState& state, BlockWords& words, MotionMode motion, LengthUnit unit);

}  // namespace frustum::parser
