#include "kinematics/model/joint_motion.hpp"

#include <cassert>

namespace frustum::kinematics {

Pose nominal_joint(const Joint& joint, double q) {
  if (joint.rotary()) {
    return {rotation_about(joint.direction, joint.side * q), joint.offset};
  }
  return Pose::translated(joint.offset + joint.side * q * joint.direction);
}

ComponentErrors component_errors(const AxisErrors& errors, AxisLetter axis, const AxisState& at) {
  ComponentErrors e;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (!errors.component[k].is_zero()) e.shift[i] = errors.component[k](axis, at);
    if (!errors.component[k + 3].is_zero()) e.turn[i] = errors.component[k + 3](axis, at);
  }
  return e;
}

ChainFrames error_frames(std::span<const Joint> joints, RotaryErrorFrame frame,
                         const AxisPositions& q, const Vec3& end) {
  assert(joints.size() <= ChainFrames::kMostJoints);
  ChainFrames chain;
  Pose bed_from_previous;
  for (const Joint& joint : joints) {
    ErrorFrames& f = chain.frames[chain.count++];
    f.joint = &joint;
    f.place = bed_from_previous * Pose::translated(joint.offset);
    bed_from_previous = bed_from_previous * nominal_joint(joint, q[joint.letter]);
    const bool moved = !joint.rotary() || frame == RotaryErrorFrame::rotor;
    f.act = moved ? bed_from_previous.rotation : f.place.rotation;
    const Vec3& origin = moved ? bed_from_previous.translation : f.place.translation;
    f.pivot = origin + f.act * joint.functional_point.point;
  }
  chain.bed_from_end = bed_from_previous * Pose::translated(end);
  for (ErrorFrames& f : chain.frames) {
    if (f.joint != nullptr && f.joint->functional_point.at_tip)
      f.pivot = chain.bed_from_end.translation;
  }
  return chain;
}

ChainFrames tool_side_frames(const Machine& machine, const AxisPositions& q, double tool_length) {
  return error_frames(machine.tool_chain(), machine.rotary_error_frame(), q,
                      machine.spindle_offset() - tool_length * Vec3::UnitZ());
}

ChainFrames work_side_frames(const Machine& machine, const AxisPositions& q) {
  return error_frames(machine.work_chain(), machine.rotary_error_frame(), q,
                      machine.table_offset());
}

Vec3 grid_pivot(const ChainFrames& tool_side) {
  Vec3 pivot = Vec3::Zero();
  for (const ErrorFrames& f : tool_side.joints()) {
    if (!f.joint->rotary()) pivot = f.pivot;
  }
  return pivot;
}

}  // namespace frustum::kinematics
