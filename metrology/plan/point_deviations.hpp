// A plan whose ruled features are told point by point: what follows errors in proportion, where
// profiles only grow.
//
// Model    : a deviation for each planned point of each ruled feature, "s.A[17]", in place of the
//            profiles of such features alone
// Units    : mm
// Shape    : as many characteristics more as there are points
// Errors   : none
// Accuracy : exact
// Source   : ours
#pragma once

#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

// With a deviation for each point of ruled features, after all others.
[[nodiscard]] InspectionPlan with_point_deviations(InspectionPlan plan);
// Without the profiles of ruled features, which have no derivative.
[[nodiscard]] InspectionPlan without_surface_profiles(InspectionPlan plan);

}  // namespace frustum::metrology
