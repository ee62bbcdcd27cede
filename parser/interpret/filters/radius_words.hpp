// Cutter radius compensation in a program: its words, what may not happen while it is on, and how
// it ends.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <cstdint>
#include <optional>

#include "parser/interpret/filters/motion_filters.hpp"
#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome check_radius_compensation(const InterpreterState& state,
                                                const MotionFilters& filters,
                                                const BlockWords& words, const Movement& movement);
// Of Fanuc: what parameters decide of the contour that the block has gone on along.
void tell_contour_settings(InterpreterState& state, MotionFilters& filters,
                           const BlockWords& words);
[[nodiscard]] Outcome set_radius_compensation(InterpreterState& state, MotionFilters& filters,
                                              const BlockWords& words);
// The contour ends where the program is: the place of the tool's centre, when it was beside it.
std::optional<Vec2> stop_radius_compensation(InterpreterState& state, MotionFilters& filters,
                                             std::uint32_t column);
[[nodiscard]] Outcome end_radius_compensation(InterpreterState& state, MotionFilters& filters,
                                              const SourcePlace& place);

}  // namespace frustum::parser
