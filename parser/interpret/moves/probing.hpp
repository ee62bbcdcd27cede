// Probing: G38.2 to G38.5, and Fanuc's G31.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

// The program goes on as if the probe had come to its end and met nothing.
[[nodiscard]] Outcome probe(InterpreterState& state, const BlockWords& words,
                            const Movement& movement);

}  // namespace frustum::parser
