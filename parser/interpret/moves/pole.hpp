// Poles, places about them, and arcs that lead on from the move before: CC, LP, CP, CTP and CT of
// Klartext; G110 to G112, AP=, RP= and CT of Sinumerik.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include "parser/arc.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome set_pole(InterpreterState& state, const BlockWords& words);
// G110, G111, G112: along the plane's axes, or by radius and angle.
[[nodiscard]] Outcome set_pole_in_plane(InterpreterState& state, const BlockWords& words,
                                        NonModal from);
// PR and PA, RP= and AP=; what is not given stays as it is about the pole.
[[nodiscard]] Outcome set_target_about_pole(InterpreterState& state, const BlockWords& words);
// G2 and G3 with a polar end.
[[nodiscard]] Outcome turn_about_pole(const InterpreterState& state, const BlockWords& words,
                                      const Movement& movement, ArcWords& arc);
// IPA has the sign of DR.
[[nodiscard]] Outcome check_turned_angle(const InterpreterState& state, const BlockWords& words,
                                         const ArcWords& arc);
// The arc that leaves its start in the direction of the last move.
[[nodiscard]] Outcome lead_on(const InterpreterState& state, const Movement& movement,
                              ArcWords& arc);
// A move that stays where it was in the plane has no direction; the one before it counts.
void keep_heading(InterpreterState& state, const AxisTarget& before);

}  // namespace frustum::parser
