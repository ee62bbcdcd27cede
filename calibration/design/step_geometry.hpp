// Step patterns as the recipes want them, from an inspection plan and what was measured by it.
//
// Model    : H, L, Cy, h and l follow from where the plan has the lines S and B of steps c and d:
//            S_c and S_d stand L apart about the centre; S is h/2 above B, or at H itself without
//            a B; B is l/2 outside S
// Units    : mm, rad; frame: workpiece frame of the plan, Z from the tilt axis
// Shape    : one StepMeasurement for each pattern that has lines S_c and S_d and a measured value
// Errors   : none; characteristics of other kinds are passed over
// Accuracy : rounding
// Source   : Ibaraki et al. 2010, section 3.1
#pragma once

#include <vector>

#include "calibration/design/step_recipes.hpp"
#include "calibration/identify/piece_observations.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::calibration {

[[nodiscard]] std::vector<StepMeasurement> step_measurements(const metrology::InspectionPlan& plan,
                                                             const MeasuredPart& measured);

}  // namespace frustum::calibration
