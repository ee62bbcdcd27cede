// What characteristics would be if every point deviated by what its plan says that the cutter
// leaves: of the method, not of the machine.
//
// Model    : the planned points moved along their normals by the strategy's `geometric`, evaluated
//            as measured ones
// Units    : mm, rad
// Shape    : one value for each characteristic; nothing for those whose features have no such
//            deviations
// Errors   : none; where an evaluation fails there is no value
// Accuracy : that of the evaluation
// Source   : ours
#pragma once

#include <optional>
#include <vector>

#include "metrology/measurement.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

// Sets CharacteristicResult::geometric and MeasuredFeature::geometric of a measurement by `plan`.
void add_geometric_values(Measurement& measurement, const InspectionPlan& plan);

}  // namespace frustum::metrology
