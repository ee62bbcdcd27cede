// What small errors do to the tool pose, to first order.
//
// Model    : every error is a small twist (translation tau, rotation theta about a point o) of one frame
//            of a chain: a point r that the frame carries moves by tau + theta x (r - o). Errors of the
//            tool chain move tip and axis so, errors of the work chain move the table the same way and
//            the tool, seen from it, the other way round
// Units    : mm, rad; frame: table
// Shape    : one walk along both chains gives the effect of all errors together; it is linear in them,
//            so the derivative to one error is the displacement by its unit
// Errors   : none
// Accuracy : agrees with central differences of actual_pose() to 1e-8 relative
//            (tests/kinematics/error_gain_test.cpp)
// Source   : first-order rigid motion; where each error acts: chain.hpp
#pragma once

#include "core/pose.hpp"
#include "kinematics/geometric_errors.hpp"
#include "kinematics/machine.hpp"

namespace frustum::kinematics {

// The tip moves by `tip`, the tool turns by the small rotation `turn` about it.
struct PoseDisplacement {
  Vec3 tip = Vec3::Zero();
  Vec3 turn = Vec3::Zero();

  // Of the tool's point that lies `from_tip` off the tip.
  [[nodiscard]] Vec3 at(const Vec3& from_tip) const { return tip + turn.cross(from_tip); }
};

[[nodiscard]] PoseDisplacement first_order_displacement(const Machine& machine,
                                                        const GeometricErrors& errors,
                                                        const AxisState& at, double tool_length);

}  // namespace frustum::kinematics
