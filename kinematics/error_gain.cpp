#include "kinematics/error_gain.hpp"

#include "kinematics/joint_motion.hpp"

namespace frustum::kinematics {
namespace {

// Sums the twists of one chain's errors as they act on a point at the chain's end.
class TwistSum {
 public:
  TwistSum(const Machine& machine, const GeometricErrors& errors, const AxisState& at)
      : machine_(machine), errors_(errors), at_(at), q_(at.q) {}

  // Displacement, in the bed frame, of `point` (bed frame) carried by the end of the chain.
  [[nodiscard]] PoseDisplacement of(std::span<const Joint> joints, const Pose& end,
                                    const Vec3& point) const {
    PoseDisplacement sum;
    Pose bed_from_previous;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const Joint& joint = joints[i];
      const double q = q_[joint.letter];
      const JointErrors e = errors_at(errors_[joint.letter], joint.letter, at_);
      const Vec3 pivot = functional_point(machine_, joints, i, q_, end);
      const Pose bed_from_place = bed_from_previous * Pose::translated(joint.offset);
      const Pose bed_from_joint = bed_from_previous * nominal_joint(joint, q);
      if (joint.rotary()) {
        const bool stator = machine_.rotary_error_frame() == RotaryErrorFrame::stator;
        add(sum, bed_from_place, {e.location, e.orientation}, Vec3::Zero(), point);
        add(sum, stator ? bed_from_place : bed_from_joint, {e.shift, e.turn}, pivot, point);
      } else {
        const Vec3 motion = joint.side * q * joint.direction;
        const Vec3 line_tilt = e.orientation.cross(motion + pivot);
        add(sum, bed_from_place, {e.location + line_tilt, e.carried_tilt}, Vec3::Zero(), point);
        add(sum, bed_from_joint, {e.shift, e.turn}, pivot, point);
      }
      bed_from_previous = bed_from_joint;
    }
    return sum;
  }

 private:
  // A twist in `bed_from_frame`, turning about `pivot` of that frame.
  static void add(PoseDisplacement& sum, const Pose& bed_from_frame, const PoseDisplacement& twist,
                  const Vec3& pivot, const Vec3& point) {
    const Vec3 turn = bed_from_frame.direction(twist.turn);
    sum.tip +=
        bed_from_frame.direction(twist.tip) + turn.cross(point - bed_from_frame.point(pivot));
    sum.turn += turn;
  }

  const Machine& machine_;
  const GeometricErrors& errors_;
  const AxisState& at_;
  const AxisPositions& q_;
};

Pose bed_from_end(std::span<const Joint> joints, const AxisPositions& q, const Pose& end) {
  Pose pose;
  for (const Joint& joint : joints) pose = pose * nominal_joint(joint, q[joint.letter]);
  return pose * end;
}

}  // namespace

PoseDisplacement first_order_displacement(const Machine& machine, const GeometricErrors& errors,
                                          const AxisState& at, double tool_length) {
  const Pose tip_end = Pose::translated(machine.spindle_offset() - tool_length * Vec3::UnitZ());
  const Pose table_end = Pose::translated(machine.table_offset());
  const Vec3 tip = bed_from_end(machine.tool_chain(), at.q, tip_end).translation;
  const Mat3 table_from_bed =
      bed_from_end(machine.work_chain(), at.q, table_end).rotation.transpose();
  const TwistSum twists(machine, errors, at);
  PoseDisplacement of_tool = twists.of(machine.tool_chain(), tip_end, tip);
  if (errors.has_grid()) {
    const GridErrors grid = errors.grid_at(at.q);
    of_tool.tip += grid.shift + grid.turn.cross(tip - grid_pivot(machine, at.q, tip_end));
    of_tool.turn += grid.turn;
  }
  const PoseDisplacement of_table = twists.of(machine.work_chain(), table_end, tip);
  return {table_from_bed * (of_tool.tip - of_table.tip),
          table_from_bed * (of_tool.turn - of_table.turn)};
}

}  // namespace frustum::kinematics
