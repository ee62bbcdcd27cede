// An arc as straight moves: where a frame turns its plane out of those of X, Y and Z, no arc
// command could say it.
//
// Units : mm, rad, mm/min
// Errors: an arc that is nearly straight
#pragma once

#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

// Of an arc in words from `start`, with all of its turns.
[[nodiscard]] Outcome cut_arc_into_chords(InterpreterState& state, const Movement& movement,
                                          const AxisTarget& start, const ArcFeed& arc);

}  // namespace frustum::parser
