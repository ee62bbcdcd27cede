#include "kinematics/joint_motion.hpp"

namespace frustum::kinematics {

Pose nominal_joint(const Joint& joint, double q) {
  if (joint.rotary()) {
    return {rotation_about(joint.direction, joint.side * q), joint.offset};
  }
  return Pose::translated(joint.offset + joint.side * q * joint.direction);
}

JointErrors errors_at(const AxisErrors& errors, AxisLetter axis, const AxisState& at) {
  JointErrors e;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    if (!errors.component[k].is_zero()) e.shift[i] = errors.component[k](axis, at);
    if (!errors.component[k + 3].is_zero()) e.turn[i] = errors.component[k + 3](axis, at);
    e.location[i] = errors.location[k];
    e.orientation[i] = errors.location[k + 3];
  }
  e.carried_tilt = errors.carried_tilt;
  return e;
}

Vec3 functional_point(const Machine& machine, std::span<const Joint> joints, std::size_t i,
                      const AxisPositions& q, const Pose& end) {
  const Joint& joint = joints[i];
  if (!joint.functional_point.at_tip) return joint.functional_point.point;
  Pose from_end = end;
  for (std::size_t k = joints.size(); k-- > i + 1;) {
    from_end = nominal_joint(joints[k], q[joints[k].letter]) * from_end;
  }
  const bool before_rotation =
      joint.rotary() && machine.rotary_error_frame() == RotaryErrorFrame::stator;
  if (before_rotation) {
    from_end =
        Pose::rotated(rotation_about(joint.direction, joint.side * q[joint.letter])) * from_end;
  }
  return from_end.translation;
}

Vec3 grid_pivot(const Machine& machine, const AxisPositions& q, const Pose& end) {
  const std::span<const Joint> joints = machine.tool_chain();
  Vec3 pivot = Vec3::Zero();
  Pose bed_from_joint;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    bed_from_joint = bed_from_joint * nominal_joint(joints[i], q[joints[i].letter]);
    if (joints[i].rotary()) continue;
    pivot = bed_from_joint.point(functional_point(machine, joints, i, q, end));
  }
  return pivot;
}

}  // namespace frustum::kinematics
