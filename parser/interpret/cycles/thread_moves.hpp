// Moves synchronised with the spindle: G33, rigid tapping G33.1, G331 and G332, the threading cycle
// G76.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome move_along_thread(InterpreterState& state, const BlockWords& words,
                                        const Movement& movement);
[[nodiscard]] Outcome tap_rigidly(InterpreterState& state, const BlockWords& words,
                                  const Movement& movement);
// G331, G332: the lead's sign and the way say how the spindle turns; it rests before and after.
[[nodiscard]] Outcome tap_one_way(InterpreterState& state, const BlockWords& words,
                                  const Movement& movement);
[[nodiscard]] Outcome cut_thread(InterpreterState& state, const BlockWords& words,
                                 const Movement& movement);

}  // namespace frustum::parser
