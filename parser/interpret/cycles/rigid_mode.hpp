// Rigid taps of Fanuc: G84 and G74 after M29, or with the spindle at rest.
//
// M29 lasts until G80, or a G word of another motion, ends it. Between it and its first hole the
// axes may not move and no S may come: the control stops with an alarm. What else ends it, as M3
// and M6 do, is for the machine's builder, and an assumption.
//
// Units : mm, mm/min, 1/min
// Errors: alarms of the control, and taps whose lead is not known; with line, column and hint
// Source: Fanuc's alarms PS0203 (M29 or S at a wrong place), PS0204 (axes that move between M29 and
//         the tap), PS0205 (the builder's signal of rigid mode is off), PS0206 (change of plane)
#pragma once

#include <optional>

#include "parser/interpret/cycles/canned_cycle_call.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

// The words of a block that begin or end the mode.
[[nodiscard]] Outcome set_rigid_mode(InterpreterState& state, const BlockWords& words);
// The block has been carried out.
void watch_rigid_mode(InterpreterState& state, const BlockWords& words);
// How the cycle at work taps its hole; absent: not rigidly.
[[nodiscard]] Result<std::optional<RigidTap>> rigid_tap_of(InterpreterState& state,
                                                           const Movement& movement,
                                                           const Feed& feed);

}  // namespace frustum::parser
