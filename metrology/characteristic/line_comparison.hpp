// Two lines against each other: how far apart and at which angle, less what is planned.
//
// Model    : both lines shifted to their planned heights (best_shifted_line.hpp), deviations from the planned
//            lines fitted by straight lines over the place along the first; distance = second less
//            first at the planned point of the first; angle = atan(slope) of the second less that
//            of the first
// Units    : mm, rad
// Shape    : two features of kind line in one frame, in which the plan holds
// Errors   : points at one place along a line
// Accuracy : second order in the tilt of a surface against its plan: 1e-4 rad on a ball of 1.5 mm is
//            1e-8 mm (tests/metrology/line_characteristic_test.cpp)
// Source   : Ibaraki et al. 2010, section 3: dL, dH, theta and phi of a machined step
#pragma once

#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/measurement.hpp"

namespace frustum::metrology {

struct LineComparison {
  double value = 0.0;                   // mm or rad, less the planned
  std::vector<LineProfile> profiles{};  // first, second
};
[[nodiscard]] Result<LineComparison> compare_lines(const PlannedCharacteristic& planned,
                                                   const FittedFeature& first,
                                                   const FittedFeature& second);

}  // namespace frustum::metrology
