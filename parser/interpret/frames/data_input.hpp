// G10: what a program writes into the control's data, by its L word.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <cstdint>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// Offsets of radii that the program writes, by G10 or parameters.
void assume_radius(InterpreterState& state, std::uint32_t column);
[[nodiscard]] Outcome set_data(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
