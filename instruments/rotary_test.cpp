#include "instruments/rotary_test.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/constants.hpp"
#include "instruments/reach.hpp"
#include "kinematics/model/inverse.hpp"
#include "kinematics/model/joint_motion.hpp"

namespace frustum::instruments {
namespace {

using kinematics::AxisPositions;
using kinematics::Joint;
using kinematics::Machine;

constexpr std::array<std::string_view, 3> kDirectionNames{"axial", "radial", "tangential"};
constexpr double kOvershoot = 2.0 * kRadPerDeg;  // before and after the capture

// The parts of a chain about one of its joints.
struct SplitChain {
  Pose bed_from_rotor{};  // the joint's motion included
  Pose rotor_from_end{};
};

SplitChain split(const std::vector<Joint>& chain, kinematics::AxisLetter at, const AxisPositions& q,
                 const Vec3& end) {
  SplitChain parts;
  bool beyond = false;
  for (const Joint& joint : chain) {
    Pose& part = beyond ? parts.rotor_from_end : parts.bed_from_rotor;
    part = part * nominal_joint(joint, q[joint.letter]);
    beyond = beyond || joint.letter == at;
  }
  parts.rotor_from_end = parts.rotor_from_end * Pose::translated(end);
  return parts;
}

Vec3 turned_about(const Joint& joint, double angle, const Vec3& v) {
  const double s = std::sin(angle), c = std::cos(angle);
  const Vec3& e = joint.direction;
  return c * v + s * e.cross(v) + ((1.0 - c) * e.dot(v)) * e;
}

// From the rotor of a joint to the bed.
Vec3 turned_by(const std::vector<Joint>& chain, kinematics::AxisLetter rotor,
               const AxisPositions& q, Vec3 v) {
  bool inside = false;
  for (auto joint = chain.rbegin(); joint != chain.rend(); ++joint) {
    inside = inside || joint->letter == rotor;
    if (inside && joint->rotary()) v = turned_about(*joint, joint->side * q[joint->letter], v);
  }
  return v;
}

// From the bed to the end of the chain.
Vec3 turned_back_by(const std::vector<Joint>& chain, const AxisPositions& q, Vec3 v) {
  for (const Joint& joint : chain) {
    if (joint.rotary()) v = turned_about(joint, -joint.side * q[joint.letter], v);
  }
  return v;
}

// The unit arm from the axis to the ball, in the frame of the rotor.
Vec3 arm_of(const Vec3& ball, const Vec3& axis) {
  // A ball within a nanometre of the axis has no side.
  constexpr double kOnAxis = 1e-6;
  const auto across = [&](const Vec3& v) -> Vec3 { return v - v.dot(axis) * axis; };
  const Vec3 arm = across(ball);
  if (arm.norm() > kOnAxis) return arm.normalized();
  const Vec3 x = across(Vec3::UnitX());
  return x.norm() > 0.5 ? x.normalized() : across(Vec3::UnitY()).normalized();
}

class BarPath {
 public:
  BarPath(const Machine& machine, const RotaryTest& test)
      : machine_(machine), test_(test), joint_(*machine.joint(test.axis)) {
    AxisPositions zero = test.held;
    zero[test.axis] = 0.0;
    const SplitChain parts = chain_at(zero);
    const bool on_tool = joint_.side > 0;
    const Vec3 ball =
        on_tool ? parts.rotor_from_end.translation : parts.rotor_from_end.point(test.table_ball);
    const Vec3 arm = arm_of(ball, joint_.direction);
    in_rotor_ = test.direction == BarDirection::axial    ? joint_.direction
                : test.direction == BarDirection::radial ? Vec3(on_tool ? -arm : arm)
                                                         : joint_.direction.cross(arm);
    in_bed_at_zero_ = parts.bed_from_rotor.rotation * in_rotor_;
    in_table_ = parts.rotor_from_end.rotation.transpose() * in_rotor_;
  }

  // Spindle ball, table frame.
  [[nodiscard]] Vec3 tip_at(const AxisPositions& q) const {
    return test_.table_ball + test_.length * direction_at(q);
  }
  [[nodiscard]] AxisPositions turned(double angle) const {
    AxisPositions q = test_.held;
    q[test_.axis] = angle;
    return q;
  }
  [[nodiscard]] AxisPositions axes_at(double angle) const {
    const AxisPositions q = turned(angle);
    return place_tip(machine_, tip_at(q), test_.tool_length, q);
  }

 private:
  // Of the bar, table frame.
  [[nodiscard]] Vec3 direction_at(const AxisPositions& q) const {
    const bool on_tool = joint_.side > 0;
    if (test_.hold == BarHold::rotor && !on_tool) return in_table_;
    const Vec3 in_bed = test_.hold == BarHold::rotor
                            ? turned_by(machine_.tool_chain(), test_.axis, q, in_rotor_)
                            : in_bed_at_zero_;
    return turned_back_by(machine_.work_chain(), q, in_bed);
  }
  [[nodiscard]] SplitChain chain_at(const AxisPositions& q) const {
    return joint_.side > 0 ? split(machine_.tool_chain(), test_.axis, q,
                                   machine_.spindle_offset() - test_.tool_length * Vec3::UnitZ())
                           : split(machine_.work_chain(), test_.axis, q, machine_.table_offset());
  }

  const Machine& machine_;
  RotaryTest test_;
  const Joint& joint_;
  Vec3 in_rotor_ = Vec3::UnitX();
  Vec3 in_bed_at_zero_ = Vec3::UnitX();
  Vec3 in_table_ = Vec3::UnitX();  // of a bar that is held on the rotor of a table
};

std::optional<Diagnostic> impossible_rotary(const Machine& machine, const RotaryTest& test) {
  const Joint* joint = machine.joint(test.axis);
  if (joint == nullptr || !joint->rotary()) {
    std::vector<char> rotary;
    for (const Joint& j : machine.joints()) {
      if (j.rotary()) rotary.push_back(to_char(j.letter));
    }
    return error(
        "unknown-axis"_id,
        fmt::format("{} is no rotary axis of machine {}", to_char(test.axis), machine.name()),
        rotary.empty() ? "the machine has none"
                       : fmt::format("rotary axes: {}", fmt::join(rotary, ", ")));
  }
  if (!(test.length > 0.0)) {
    return error("out-of-range"_id,
                 fmt::format("the bar is {:g} mm long: expected a length above 0", test.length));
  }
  if (test.angles.empty()) {
    return error("no-samples"_id, "the test has no angles to be sampled at");
  }
  return std::nullopt;
}

}  // namespace

std::string_view name_of(BarDirection direction) {
  return kDirectionNames[static_cast<std::size_t>(direction)];
}

std::optional<BarDirection> bar_direction_named(std::string_view text) {
  const auto found = std::ranges::find(kDirectionNames, text);
  if (found == kDirectionNames.end()) return std::nullopt;
  return static_cast<BarDirection>(found - kDirectionNames.begin());
}

std::string_view name_of(BarHold hold) { return hold == BarHold::rotor ? "rotor" : "bed"; }

BarHold standing_hold(const Joint& axis) { return axis.side > 0 ? BarHold::bed : BarHold::rotor; }

kinematics::AxisRange capture_of(const Joint& axis) {
  if (axis.endless || axis.travel.width() >= kTurn) return {0.0, kTurn};
  return axis.travel;
}

Result<MotionTest> rotary_test(const Machine& machine, const RotaryTest& rotary) {
  if (const auto problem = impossible_rotary(machine, rotary)) return *problem;
  const BarPath path(machine, rotary);
  MotionTest test{
      .table_ball = rotary.table_ball, .bar = rotary.length, .tool_length = rotary.tool_length};
  take_poses(test, rotary.angles, [&](double angle) -> TestPose {
    const AxisPositions q = path.turned(angle);
    const Vec3 tip = path.tip_at(q);
    return {angle, place_tip(machine, tip, rotary.tool_length, q), tip};
  });
  const auto [least, most] = std::ranges::minmax(rotary.angles);
  test.motion = {[path](double angle) { return path.axes_at(angle); }, least - kOvershoot,
                 most + kOvershoot};
  if (auto problem = out_of_reach(machine, test, std::string(1, to_char(rotary.axis)))) {
    return *std::move(problem);
  }
  return test;
}

}  // namespace frustum::instruments
