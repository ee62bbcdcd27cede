#include "programs/step/tilting_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustum::programs {
namespace {

using kinematics::AxisLetter;
using kinematics::AxisPositions;
using kinematics::Joint;
using kinematics::Machine;

// Directions of a machine file are unit within this.
constexpr double kAlong = 1e-9;
// Half a nanometre or nanoradian, as the controller's travel check: a limit reached with rounding.
constexpr double kLimitSlack = 5e-10;

bool lies_along(const Vec3& direction, const Vec3& axis) {
  return direction.cross(axis).norm() < kAlong;
}

Diagnostic unsuitable(const Machine& machine, const std::string& why) {
  return error(
      "wrong-machine-kind"_id,
      fmt::format("machine {} ({}) cannot cut step patterns: {}", machine.name(),
                  machine.structure(), why),
      "they need a table that tilts about X or Y and turns about Z, with linear axes along "
      "X, Y and Z that it does not carry");
}

}  // namespace

Result<TiltingTable> TiltingTable::of(const Machine& machine) {
  std::vector<const Joint*> rotary;
  bool carried_linear = false;
  Vec3 place = Vec3::Zero();
  Vec3 tilt_point = Vec3::Zero(), turn_point = Vec3::Zero();
  for (const Joint& joint : machine.work_chain()) {
    place += joint.offset;
    if (!joint.rotary()) {
      carried_linear = carried_linear || !rotary.empty();
      continue;
    }
    rotary.push_back(&joint);
    (rotary.size() == 1 ? tilt_point : turn_point) = place;
  }
  for (const Joint& joint : machine.tool_chain()) {
    if (joint.rotary()) {
      return unsuitable(machine,
                        fmt::format("{} turns the tool, not the workpiece", to_char(joint.letter)));
    }
  }
  if (rotary.size() != 2) {
    return unsuitable(machine, fmt::format("it has {} rotary axes on the workpiece side, not two",
                                           rotary.size()));
  }
  const Joint& tilt = *rotary[0];
  const Joint& turn = *rotary[1];
  const bool about_x = lies_along(tilt.direction, Vec3::UnitX());
  if (!about_x && !lies_along(tilt.direction, Vec3::UnitY())) {
    return unsuitable(machine,
                      fmt::format("{}, the outer rotary axis, is parallel to neither X nor Y",
                                  to_char(tilt.letter)));
  }
  if (!lies_along(turn.direction, Vec3::UnitZ())) {
    return unsuitable(
        machine, fmt::format("{}, the inner rotary axis, is not vertical", to_char(turn.letter)));
  }
  const auto askew = [](const Joint& joint) {
    const auto k = static_cast<Eigen::Index>(joint.letter);
    return !joint.rotary() && (joint.direction - Vec3::Unit(k)).norm() > kAlong;
  };
  const std::vector<Joint> joints = machine.joints();
  if (carried_linear || std::any_of(joints.begin(), joints.end(), askew)) {
    return unsuitable(machine, carried_linear ? "the table carries a linear axis"
                                              : "its linear axes are not parallel to X, Y and Z");
  }
  TiltingTable table;
  table.tilt = tilt.letter;
  table.turn = turn.letter;
  table.tilt_sense = tilt.direction[about_x ? 0 : 1] > 0.0 ? 1.0 : -1.0;
  table.turn_sense = turn.direction.z() > 0.0 ? 1.0 : -1.0;
  table.orientation = about_x ? 0.0 : 0.5 * std::numbers::pi;
  const Vec3 origin = place + machine.table_offset();
  table.crossing = Vec3(turn_point.x(), turn_point.y(), tilt_point.z()) - origin;
  return table;
}

AxisPositions TiltingTable::positions(const Machine& machine, double a, double c) const {
  AxisPositions q;
  q[tilt] = tilt_sense * a;
  q[turn] = turn_sense * c;
  const Joint& joint = *machine.joint(turn);
  if (joint.endless) return q;
  const auto outside = [&](double at) {
    return at < joint.travel.lo - kLimitSlack || at > joint.travel.hi + kLimitSlack;
  };
  for (const double turned : {2.0 * std::numbers::pi, -2.0 * std::numbers::pi}) {
    if (outside(q[turn]) && !outside(q[turn] + turned)) q[turn] += turned;
  }
  return q;
}

std::vector<Shortfall> shortfalls(const Machine& machine, const AxisPositions& q) {
  std::vector<Shortfall> found;
  for (const Joint& joint : machine.joints()) {
    if (joint.endless) continue;
    const double at = q[joint.letter];
    const double missing = std::max(joint.travel.lo - at, at - joint.travel.hi);
    if (!(missing > kLimitSlack)) continue;
    const double scale = joint.rotary() ? kDegPerRad : 1.0;
    const char* unit = joint.rotary() ? "deg" : "mm";
    found.push_back({joint.letter, at, missing,
                     fmt::format("{} = {:.6g} {}, travel {:g} .. {:g} {}: {:.6g} {} short",
                                 to_char(joint.letter), at * scale, unit, joint.travel.lo * scale,
                                 joint.travel.hi * scale, unit, missing * scale, unit)});
  }
  return found;
}

}  // namespace frustum::programs
