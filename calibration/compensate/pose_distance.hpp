// How far apart two tool poses are, in tip and direction together, and how far along a way.
//
// Model    : a radian of the tool axis counts as 20 mm of the tip
// Units    : mm
// Errors   : none
#pragma once

#include <algorithm>
#include <cmath>

#include "kinematics/model/tool_pose.hpp"

namespace frustum::calibration {

inline constexpr double kReach = 20.0;  // mm

[[nodiscard]] inline double distance(const kinematics::ToolPose& a, const kinematics::ToolPose& b) {
  return std::hypot((b.tip - a.tip).norm(), kReach * (b.axis - a.axis).norm());
}

// How far from start to end the place nearest to `pose` is, 0 to 1; 1 where there is no way.
[[nodiscard]] inline double share_of_way(const kinematics::ToolPose& start,
                                         const kinematics::ToolPose& end,
                                         const kinematics::ToolPose& pose) {
  const Vec3 tip = end.tip - start.tip;
  const Vec3 axis = kReach * (end.axis - start.axis);
  const double length2 = tip.squaredNorm() + axis.squaredNorm();
  if (length2 == 0.0) return 1.0;
  const double foot = tip.dot(pose.tip - start.tip) + axis.dot(kReach * (pose.axis - start.axis));
  return std::clamp(foot / length2, 0.0, 1.0);
}

}  // namespace frustum::calibration
