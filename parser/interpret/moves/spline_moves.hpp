// The splines of a program: G5, G5.1, and the points of G5.2 up to G5.3.
//
// Units : mm, rad, mm/min
// Errors: the first one of the block, with line, column and hint
#pragma once

#include <optional>

#include "parser/interpret/state/block_words.hpp"
#include "parser/interpret/state/interpreter_state.hpp"
#include "parser/interpret/state/movement.hpp"

namespace frustum::parser {

[[nodiscard]] Outcome move_along_spline(InterpreterState& state, const BlockWords& words,
                                        const Movement& movement);
// Between G5.2 and G5.3 are control points, and what moves nothing.
[[nodiscard]] Outcome check_open_nurbs(const InterpreterState& state, const Movement& movement);
[[nodiscard]] std::optional<Diagnostic> spline_without_end(const InterpreterState& state);

}  // namespace frustum::parser
