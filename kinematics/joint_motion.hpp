// One joint of a machine: its nominal motion and its errors at a position.
//
// Units  : mm, rad; frames as in chain.hpp
// Errors : none
#pragma once

#include <span>

#include "core/pose.hpp"
#include "kinematics/axes.hpp"
#include "kinematics/geometric_errors.hpp"
#include "kinematics/machine.hpp"

namespace frustum::kinematics {

// previous_from_joint at position q, without errors.
[[nodiscard]] Pose nominal_joint(const Joint& joint, double q);

// The errors of one axis where the axes are.
struct JointErrors {
  Vec3 shift = Vec3::Zero();        // component translations
  Vec3 turn = Vec3::Zero();         // component rotations
  Vec3 location = Vec3::Zero();     // location translations
  Vec3 orientation = Vec3::Zero();  // location rotations
  Vec3 carried_tilt = Vec3::Zero();
};
[[nodiscard]] JointErrors errors_at(const AxisErrors& errors, AxisLetter axis, const AxisState& at);

// The point about which the component rotations of joints[i] turn, in the frame where they act.
// `end` is what follows the last joint: where the tip or the table is in its frame.
[[nodiscard]] Vec3 functional_point(const Machine& machine, std::span<const Joint> joints,
                                    std::size_t i, const AxisPositions& q, const Pose& end);

// The point of the bed about which a volumetric grid turns the tool chain: the functional point of the chain's
// last linear axis, where it nominally is; the bed's origin where there is none.
[[nodiscard]] Vec3 grid_pivot(const Machine& machine, const AxisPositions& q, const Pose& end);

}  // namespace frustum::kinematics
