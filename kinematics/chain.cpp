#include "kinematics/chain.hpp"

#include <cmath>
#include <span>

#include "kinematics/joint_motion.hpp"

namespace frustum::kinematics {
namespace {

Mat3 small_rotation(const Vec3& angles, RotationOrder order) {
  if (angles.isZero(0.0)) return Mat3::Identity();
  const Mat3 x = rotation_x(angles.x()), y = rotation_y(angles.y()), z = rotation_z(angles.z());
  return order == RotationOrder::zyx ? Mat3(z * y * x) : Mat3(x * y * z);
}

Pose about_point(const Mat3& rotation, const Vec3& point) {
  return {rotation, point - rotation * point};
}

// One chain of the machine, walked from the bed outwards.
class ChainWalk {
 public:
  ChainWalk(const Machine& machine, const GeometricErrors* errors, const AxisState& at)
      : machine_(machine), errors_(errors), at_(at), q_(at.q) {}

  // `end` is what follows the last joint: where the tip or the table is in its frame.
  [[nodiscard]] Pose pose(std::span<const Joint> joints, const Pose& end) const {
    Pose bed_from_end;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      bed_from_end =
          bed_from_end * (errors_ == nullptr ? nominal_joint(joints[i], q_[joints[i].letter])
                                             : actual_joint(joints, i, end));
    }
    return bed_from_end * end;
  }

 private:
  [[nodiscard]] Pose actual_joint(std::span<const Joint> joints, std::size_t i,
                                  const Pose& end) const {
    const Joint& joint = joints[i];
    const double q = q_[joint.letter];
    const JointErrors e = errors_at((*errors_)[joint.letter], joint.letter, at_);
    const RotationOrder order = machine_.rotation_order();
    const Vec3 pivot = functional_point(machine_, joints, i, q_, end);
    const Pose turn = about_point(small_rotation(e.turn, order), pivot);
    if (!joint.rotary()) {
      const Pose place{small_rotation(e.carried_tilt, order), joint.offset + e.location};
      const Vec3 motion = joint.side * q * joint.direction;
      const Vec3 on_line = motion + pivot;
      const Vec3 tilt = small_rotation(e.orientation, order) * on_line - on_line;
      return place * Pose::translated(motion + tilt + e.shift) * turn;
    }
    const Pose place{small_rotation(e.orientation, order), joint.offset + e.location};
    const Pose rotate = Pose::rotated(rotation_about(joint.direction, joint.side * q));
    const Pose shift = Pose::translated(e.shift);
    if (machine_.rotary_error_frame() == RotaryErrorFrame::rotor)
      return place * rotate * turn * shift;
    return place * shift * turn * rotate;
  }

  const Machine& machine_;
  const GeometricErrors* errors_;
  const AxisState& at_;
  const AxisPositions& q_;
};

Pose table_from_tool(const Machine& machine, const GeometricErrors* errors, const AxisState& at,
                     double tool_length) {
  const ChainWalk walk(machine, errors, at);
  const Pose last_from_tip =
      Pose::translated(machine.spindle_offset() - tool_length * Vec3::UnitZ());
  Pose bed_from_tip = walk.pose(machine.tool_chain(), last_from_tip);
  if (errors != nullptr && errors->has_grid()) {
    const GridErrors grid = errors->grid_at(at.q);
    const Pose turn = about_point(small_rotation(grid.turn, machine.rotation_order()),
                                  grid_pivot(machine, at.q, last_from_tip));
    bed_from_tip = Pose::translated(grid.shift) * turn * bed_from_tip;
  }
  const Pose bed_from_table =
      walk.pose(machine.work_chain(), Pose::translated(machine.table_offset()));
  return bed_from_table.inverse() * bed_from_tip;
}

}  // namespace

Pose nominal_pose(const Machine& machine, const AxisPositions& q, double tool_length) {
  return table_from_tool(machine, nullptr, q, tool_length);
}

Pose actual_pose(const Machine& machine, const GeometricErrors& errors, const AxisState& at,
                 double tool_length) {
  return table_from_tool(machine, &errors, at, tool_length);
}

Mat3 linear_axis_directions(const Machine& machine, const AxisPositions& q) {
  Mat3 in_bed;
  Mat3 bed_from_table = Mat3::Identity();
  const auto walk = [&](const std::vector<Joint>& chain) {
    Mat3 turned = Mat3::Identity();
    for (const Joint& joint : chain) {
      if (joint.rotary()) {
        turned = turned * rotation_about(joint.direction, joint.side * q[joint.letter]);
      } else {
        // Moving the work by -q shows the same tip displacement, in the work, as moving the tool by +q.
        in_bed.col(static_cast<Eigen::Index>(joint.letter)) = turned * joint.direction;
      }
    }
    return turned;
  };
  walk(machine.tool_chain());
  bed_from_table = walk(machine.work_chain());
  return bed_from_table.transpose() * in_bed;
}

}  // namespace frustum::kinematics
