// Where a commanded motion has to be cut so that the axes move evenly enough in between.
//
// Units    : mm, rad
// Errors   : none
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "kinematics/model/axes.hpp"

namespace frustum::kinematics {

struct PolylineTolerance {
  double linear = 0.005;  // mm: what an axis may be off the straight line in the middle of a part
  double rotary = 1e-4;   // rad
};

struct EvenPart {
  double end = 1.0;  // u
  AxisPositions to{};
  // By how much more than its change every axis would go if it kept the fastest pace that it has
  // within the part: five times what it is off in the middle, where a parabola has four.
  AxisPositions unevenness{};
};

// Parts in increasing order, the last ends at 1. `cuts` in (0, 1) are always ends.
[[nodiscard]] std::vector<EvenPart> even_parts(const std::function<AxisPositions(double)>& motion,
                                               int least_parts, std::span<const double> cuts,
                                               const PolylineTolerance& tolerance = {});

}  // namespace frustum::kinematics
