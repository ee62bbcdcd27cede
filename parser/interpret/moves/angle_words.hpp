// Angles of Sinumerik that stand for a coordinate of the end: ANG= of a line, AR= of an arc.
//
// Model : ANG is the heading of the line from the first axis of the plane; AR is how far the arc
//         turns, about its centre or to its end
// Units : mm, rad; angles as written, degrees
// Errors: a coordinate too many or too few, a line that does not meet it, an angle out of range
#pragma once

#include "core/result.hpp"
#include "parser/arc.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"

namespace frustum::parser {

inline constexpr char kHeading = 'n';  // ANG=
inline constexpr char kOpening = 'o';  // AR=

// The coordinate that the block leaves out; the other one is set, `before` is the start.
[[nodiscard]] Outcome end_at_angle(InterpreterState& state, const BlockWords& words,
                                   const AxisTarget& before);
// The end of an arc that has its centre, or the radius of one that has its end.
[[nodiscard]] Outcome open_arc(const InterpreterState& state, const BlockWords& words,
                               ArcWords& arc);

}  // namespace frustum::parser
