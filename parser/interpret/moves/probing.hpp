// Probing: G38.2 to G38.5, Fanuc's G31, and the probing cycles of Klartext.
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
// TCH PROBE: what it measures is the machine's to know, and so is where the axes are afterwards.
[[nodiscard]] Outcome pass_probing(InterpreterState& state, const BlockWords& words);

}  // namespace frustum::parser
