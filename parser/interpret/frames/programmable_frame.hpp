// The programmable frame: TRANS, ROT, SCALE, MIRROR, which replace it, and ATRANS, AROT, ASCALE,
// AMIRROR, which go on within it.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

void set_program_frame(InterpreterState& state, const ProgramFrame& next);
[[nodiscard]] Outcome change_program_frame(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
