// The joints of one chain: their nominal motion, their errors at a position, and where these act.
//
// Units  : mm, rad; frames as in chain.hpp
// Errors : none
#pragma once

#include <array>
#include <span>

#include "core/pose.hpp"
#include "kinematics/model/axes.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

// previous_from_joint at position q, without errors.
[[nodiscard]] Pose nominal_joint(const Joint& joint, double q);

// The component errors of one axis where the axes are.
struct ComponentErrors {
  Vec3 shift = Vec3::Zero();
  Vec3 turn = Vec3::Zero();
};
[[nodiscard]] ComponentErrors component_errors(const AxisErrors& errors, AxisLetter axis,
                                               const AxisState& at);

// Location errors, which do not depend on where the axes are.
[[nodiscard]] inline Vec3 location_shift(const AxisErrors& errors) {
  return {errors.location[0], errors.location[1], errors.location[2]};
}
[[nodiscard]] inline Vec3 location_turn(const AxisErrors& errors) {
  return {errors.location[3], errors.location[4], errors.location[5]};
}

// Where the errors of one joint act on the nominal machine, in the frame of the bed.
struct ErrorFrames {
  const Joint* joint = nullptr;
  Pose place{};                 // location errors: the joint's frame before it moves
  Mat3 act = Mat3::Identity();  // component errors: directions
  Vec3 pivot = Vec3::Zero();    // and the point about which their rotations turn
};

// The joints of a chain, bed outwards.
struct ChainFrames {
  static constexpr std::size_t kMostJoints = 5;
  std::array<ErrorFrames, kMostJoints> frames{};
  std::size_t count = 0;
  Pose bed_from_end{};

  [[nodiscard]] std::span<const ErrorFrames> joints() const { return {frames.data(), count}; }
};

// `end` is what follows the last joint: where the tip or the table is in its frame.
[[nodiscard]] ChainFrames error_frames(std::span<const Joint> joints, RotaryErrorFrame frame,
                                       const AxisPositions& q, const Vec3& end);
[[nodiscard]] ChainFrames tool_side_frames(const Machine& machine, const AxisPositions& q,
                                           double tool_length);
[[nodiscard]] ChainFrames work_side_frames(const Machine& machine, const AxisPositions& q);

// The point of the bed about which a volumetric grid turns the tool chain: the functional point of
// the chain's last linear axis, where it nominally is; the bed's origin where there is none.
[[nodiscard]] Vec3 grid_pivot(const ChainFrames& tool_side);

}  // namespace frustum::kinematics
