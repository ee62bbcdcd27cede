// Where a tool is: its tip and its axis.
//
// Units : mm; frame: whatever the user of the pose says
// Errors: none
#pragma once

#include "core/pose.hpp"

namespace frustum::kinematics {

// The axis is the unit vector from the tip to the spindle.
struct ToolPose {
  Vec3 tip = Vec3::Zero();
  Vec3 axis = Vec3::UnitZ();  // unit
};

// The pose a fraction t in [0, 1] of the way: tip linear, axis on the great circle.
[[nodiscard]] ToolPose between(const ToolPose& from, const ToolPose& to, double t);

}  // namespace frustum::kinematics
