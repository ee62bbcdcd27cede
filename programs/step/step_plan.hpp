// What to measure on a step pattern piece.
//
// Model    : along every line S, and along every line B of steps c and d, one row of points; on the
//            bottoms of the reference steps a grid. Reference steps make the frame that the
//            patterns on them are measured in
// Units    : mm, rad; frame: workpiece
// Shape    : features "1-a.S_c", "ref.B_a"; one frame for each different pair of reference steps;
//            three to five characteristics a pattern: "1-a.dL", dH, theta, phi, dL0
// Errors   : none; the workpiece carries the patterns
// Accuracy : points are every 5 mm, to the last bit where they are planned
// Source   : Ibaraki et al. 2010, section 3
#pragma once

#include <span>
#include <string>

#include "programs/step/step_pattern.hpp"

namespace frustum::programs {

[[nodiscard]] metrology::InspectionPlan step_plan(const StepTest& test,
                                                  std::span<const std::string> patterns);

}  // namespace frustum::programs
