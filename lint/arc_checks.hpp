// Arcs that are probably not what was meant: radii that disagree, slips of a point, radii out of
// all measure.
//
// Units : mm, rad
// Errors: none; arcs that cannot be made at all are errors of the interpreter (run_errors.hpp)
#pragma once

#include "lint/cutting_move.hpp"
#include "lint/finding_list.hpp"

namespace frustum::lint {

// Half of what common controls allow by default; three written decimals leave 0.0015 mm.
constexpr double kRadiiDisagree = 0.005;  // mm
constexpr double kTinyRadius = 0.01;      // mm
constexpr double kHugeRadius = 10'000.0;  // mm
// An arc whose ends are nearer than this and that goes round is a slip of a rounded point.
constexpr double kSlip = 0.02;  // mm

void check_arc(const CuttingMove& move, FindingList& findings);

}  // namespace frustum::lint
