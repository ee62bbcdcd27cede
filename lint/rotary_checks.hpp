// Rotary axes that move while the control does not guide the tool's tip.
//
// Units : mm, rad
// Errors: none
#pragma once

#include "lint/cutting_move.hpp"
#include "lint/finding_list.hpp"
#include "parser/dialect.hpp"

namespace frustum::lint {

// In inverse time (G93) moves of both kinds of axes are written by post-processors that guide the
// tip themselves: a note.
void check_tip_control(const CuttingMove& move, const MotionState& state, parser::Dialect dialect,
                       FindingList& findings);
// A rotary axis turns, by rapid or feed, with a tool length in force and no tilted plane.
void check_rotary_with_length(const parser::Motion& motion, const MotionState& state,
                              parser::Dialect dialect, FindingList& findings);

}  // namespace frustum::lint
