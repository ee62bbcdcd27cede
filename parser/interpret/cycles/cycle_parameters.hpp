// The Q parameters of a cycle of Klartext: CYCL DEF 200 sets Q200, Q201 and so on like any other
// setting, and a call takes what they are then. Q201=-18 after CYCL DEF makes the next holes
// deeper.
//
// An event of the grade `assumed` says so. What a parameter was assigned from has no effect
// afterwards.
//
// Source: iTNC 530 (340 49x-04) User's Manual, 11.1: Q200 to Q1199 are parameters of cycles,
//         globally effective
// Units : as the program writes them
// Errors: a value that the cycle does not take, at the block of the call
#pragma once

#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

// The words of the block at work become parameters; those of a definition are kept.
void set_cycle_parameters(InterpreterState& state, const BlockWords& words, bool defines);
// The cycle as its parameters are now.
[[nodiscard]] Outcome renew_cycle(InterpreterState& state);

}  // namespace frustum::parser
