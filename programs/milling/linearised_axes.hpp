// From tool poses to axis positions that a machine without tool-centre-point control can follow.
//
// Model    : between two axis positions the tip should run straight; axes moving linearly leave
//            that line, so points are inserted by halving until they stay within the tolerance
// Units    : mm, rad
// Errors   : none: both ends are reachable, and so is what is between on the way
#pragma once

#include <vector>

#include "kinematics/model/machine.hpp"

namespace frustum::programs {

// Axis positions after `from`, up to and including `to`, such that linear axis motion between them
// keeps the tip within `tolerance` of the straight line and the rotary axes as they were going
// anyway.
[[nodiscard]] std::vector<kinematics::AxisPositions> linearised(
    const kinematics::Machine& machine, const kinematics::AxisPositions& from,
    const kinematics::AxisPositions& to, double tool_length, double tolerance);

}  // namespace frustum::programs
