// Where a commanded motion has to be cut so that the axes move evenly enough in between.
//
// Units    : mm, rad
// Errors   : none
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "kinematics/axes.hpp"

namespace frustum::kinematics {

struct PolylineTolerance {
  double linear = 0.005;  // mm: what an axis may be off the straight line in the middle of a part
  double rotary = 1e-4;   // rad
};

// Ends of the parts, increasing, the last is 1. `cuts` in (0, 1) are always among them.
[[nodiscard]] std::vector<double> even_parts(const std::function<AxisPositions(double)>& motion,
                                             int least_parts, std::span<const double> cuts,
                                             const PolylineTolerance& tolerance = {});

}  // namespace frustum::kinematics
