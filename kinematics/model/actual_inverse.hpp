// Axis positions that bring the actual tool, with all errors of the machine, to a wanted pose.
//
// Model    : starts from the positions that the nominal machine would take. The rotary corrections
//            d follow from the direction that is still missing, by Gauss-Newton on |missing|^2 +
//            stiffness^2 |d|^2; the linear axes then place the tip. The stiffness matters at the
//            pole only, where no small turn tilts the tool one way: it keeps the correction small
//            there and smooth beside it
// Units    : mm, rad; frame: table
// Errors   : none; what a machine cannot correct (the pole, missing rotary axes) is left in the
//            direction, never in the tip
// Accuracy : tip 1e-9 mm; direction 1e-12 rad times (1 + (stiffness / sine of the angle to the
//            pole)^2) (tests/kinematics/actual_inverse_test.cpp)
#pragma once

#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/model/tool_pose.hpp"

namespace frustum::kinematics {

struct ActualInverseOptions {
  // Of the error still missing at an angle theta from the pole, (stiffness / sin theta)^2 is left.
  double stiffness = 1e-3;
};

// `nominal` reaches `wanted` on the machine without errors; its approach_directions are kept.
[[nodiscard]] AxisPositions actual_inverse(const Machine& machine, const GeometricErrors& errors,
                                           const ToolPose& wanted, double tool_length,
                                           const AxisState& nominal,
                                           const ActualInverseOptions& options = {});

}  // namespace frustum::kinematics
