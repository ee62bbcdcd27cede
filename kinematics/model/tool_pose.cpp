#include "kinematics/model/tool_pose.hpp"

#include <cmath>

namespace frustum::kinematics {

ToolPose between(const ToolPose& from, const ToolPose& to, double t) {
  const Vec3 tip = from.tip + t * (to.tip - from.tip);
  const double turn = angle_between(from.axis, to.axis);
  // Below 1e-9 rad the great circle and its chord differ by less than rounding.
  if (turn < 1e-9) return {tip, (from.axis + t * (to.axis - from.axis)).normalized()};
  const double a = std::sin((1.0 - t) * turn) / std::sin(turn);
  const double b = std::sin(t * turn) / std::sin(turn);
  return {tip, a * from.axis + b * to.axis};
}

}  // namespace frustum::kinematics
