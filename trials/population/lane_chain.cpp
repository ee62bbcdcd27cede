#include "trials/population/lane_chain.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "kinematics/model/joint_motion.hpp"
#include "kinematics/model/small_rotation.hpp"
#include "trials/population/lane_kernel.hpp"

namespace frustum::trials {
namespace {

using kinematics::AxisErrors;
using kinematics::AxisState;
using kinematics::GeometricErrors;
using kinematics::Joint;
using kinematics::Machine;

std::array<double, 3> numbers_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Vec3 direction_of(const Joint& joint) { return joint.side * joint.direction; }

std::uint8_t turns_about(const Joint& joint) {
  for (std::uint8_t i = 0; i < 3; ++i) {
    if (std::abs(joint.direction[i]) == 1.0) return i;
  }
  return 3;
}

// Numbers that the motion of a joint takes.
std::size_t motion_size(const LaneJoint& lane) {
  return lane.rotary && lane.about == 3 ? 9 : lane.rotary ? 2 : 3;
}

template <typename Has>
bool any_of(const GeometricErrors& fixed, const std::vector<GeometricErrors>& units, Has has) {
  return has(fixed) || std::any_of(units.begin(), units.end(), has);
}

LaneVec3 lanes_of(const std::array<Vec3, kLanes>& vectors) {
  LaneVec3 all;
  for (std::size_t i = 0; i < kLanes; ++i) {
    all.x.of[i] = vectors[i].x();
    all.y.of[i] = vectors[i].y();
    all.z.of[i] = vectors[i].z();
  }
  return all;
}

void set(std::array<Lanes, 9>& matrix, std::size_t lane, const Mat3& value) {
  for (std::size_t k = 0; k < 9; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    matrix[k].of[lane] = value(i / 3, i % 3);
  }
}

}  // namespace

LaneChain::LaneChain(const Machine& machine, const PopulationLaws& laws,
                     const Pose& table_from_workpiece)
    : machine_(machine), fixed_(laws.fixed()) {
  for (const ErrorColumn& column : laws.columns()) units_.push_back(column.unit);
  has_grid_ = any_of(fixed_, units_, [](const GeometricErrors& e) { return e.has_grid(); });
  tables_.zyx = machine_.rotation_order() == kinematics::RotationOrder::zyx;
  const auto& tool = machine_.tool_chain();
  for (auto joint = tool.rbegin(); joint != tool.rend(); ++joint) prepare(*joint, false);
  for (const Joint& joint : machine_.work_chain()) prepare(joint, true);
  tables_.table = numbers_of(machine_.table_offset());
  const Pose workpiece_from_table = table_from_workpiece.inverse();
  for (std::size_t k = 0; k < 9; ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    tables_.workpiece_from_table[k] = workpiece_from_table.rotation(i / 3, i % 3);
  }
  tables_.workpiece_origin = numbers_of(workpiece_from_table.translation);

  std::size_t at = 3;  // the tip
  for (LaneJoint& lane : tables_.joints) {
    lane.motion_at = static_cast<std::uint32_t>(at);
    at += motion_size(lane);
    lane.pivot_at = static_cast<std::uint32_t>(at);
    if (lane.pivot == LaneJoint::Pivot::end) at += 3;
  }
  tables_.base_at = static_cast<std::uint32_t>(at);
  at += components_.size();
  tables_.entries_at = static_cast<std::uint32_t>(at);
  tables_.stride = at + tables_.column_of.size();
}

void LaneChain::prepare(const Joint& joint, bool on_work) {
  const auto index = static_cast<std::uint32_t>(tables_.joints.size());
  LaneJoint lane;
  lane.rotary = joint.rotary();
  lane.rotor = machine_.rotary_error_frame() == kinematics::RotaryErrorFrame::rotor;
  lane.on_work = on_work;
  lane.about = turns_about(joint);
  lane.pivot = joint.functional_point.at_tip              ? LaneJoint::Pivot::end
               : joint.functional_point.point.isZero(0.0) ? LaneJoint::Pivot::origin
                                                          : LaneJoint::Pivot::point;
  lane.point = numbers_of(joint.functional_point.point);
  lane.offset = numbers_of(joint.offset);
  for (std::size_t k = 0; k < 6; ++k) {
    const auto moves = [&](const GeometricErrors& e) {
      return !e[joint.letter].component[k].is_zero();
    };
    lane.component[k] = -1;
    if (!any_of(fixed_, units_, moves)) continue;
    lane.component[k] = static_cast<std::int32_t>(components_.size());
    (k < 3 ? lane.shifts : lane.turns) = true;
    components_.push_back({&joint, k});
    if (tables_.first_entry.empty()) tables_.first_entry.push_back(0);
    for (std::size_t column = 0; column < units_.size(); ++column) {
      if (moves(units_[column])) tables_.column_of.push_back(static_cast<std::uint32_t>(column));
    }
    tables_.first_entry.push_back(static_cast<std::uint32_t>(tables_.column_of.size()));
  }
  for (std::size_t column = 0; column < units_.size(); ++column) {
    const AxisErrors& e = units_[column][joint.letter];
    const auto c = static_cast<std::uint32_t>(column);
    for (std::uint32_t k = 0; k < 6; ++k) {
      if (e.location[k] != 0.0) locations_.push_back({index, k, c, e.location[k], false});
    }
    for (std::uint32_t k = 0; k < 3; ++k) {
      if (e.carried_tilt[k] != 0.0) locations_.push_back({index, k, c, e.carried_tilt[k], true});
    }
  }
  const auto leans = [&](const GeometricErrors& e) {
    return !kinematics::location_turn(e[joint.letter]).isZero(0.0);
  };
  const auto carried = [&](const GeometricErrors& e) {
    return !e[joint.letter].carried_tilt.isZero(0.0);
  };
  const bool is_turned = any_of(fixed_, units_, leans);
  lane.tilted = !lane.rotary && is_turned;
  lane.carries = lane.rotary ? is_turned : any_of(fixed_, units_, carried);
  tables_.joints.push_back(lane);
  joints_.push_back(&joint);
}

// What a joint's motion and pivot are at a place; `end` is the nominal end of its chain, in the
// frame of the joint before it moves.
void LaneChain::append(const Joint& joint, const LaneJoint& lane, const AxisState& at,
                       const Vec3& end, double* numbers) const {
  const double q = at.q[joint.letter];
  const Vec3 direction = direction_of(joint);
  double* motion = numbers + lane.motion_at;
  Vec3 pivot = end;
  if (!lane.rotary) {
    Eigen::Map<Vec3> stored(motion);
    stored = q * direction;
  } else {
    const Mat3 turned = rotation_about(direction, q);
    if (lane.about < 3) {
      motion[0] = std::sin(q) * direction[lane.about];
      motion[1] = std::cos(q);
    } else {
      Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> stored(motion);
      stored = turned;
    }
    if (!lane.rotor) pivot = turned * end;
  }
  if (lane.pivot == LaneJoint::Pivot::end) {
    Eigen::Map<Vec3> stored(numbers + lane.pivot_at);
    stored = pivot;
  }
}

std::uint32_t LaneChain::add(const AxisState& at, double tool_length) {
  tables_.numbers.resize(tables_.numbers.size() + tables_.stride);
  double* numbers = tables_.numbers.data() + count_ * tables_.stride;
  const Vec3 tip = machine_.spindle_offset() - tool_length * Vec3::UnitZ();
  Eigen::Map<Vec3> stored(numbers);
  stored = tip;
  // The nominal end of each chain as seen from its joints, from the end to the bed.
  const auto onward = [&](const Joint& joint, const Vec3& end) {
    return kinematics::nominal_joint(joint, at.q[joint.letter]).point(end);
  };
  const std::size_t tools = machine_.tool_chain().size();
  Vec3 end = tip;
  for (std::size_t i = 0; i < tools; ++i) {
    append(*joints_[i], tables_.joints[i], at, end, numbers);
    end = onward(*joints_[i], end);
  }
  end = machine_.table_offset();
  for (std::size_t i = joints_.size(); i-- > tools;) {
    append(*joints_[i], tables_.joints[i], at, end, numbers);
    end = onward(*joints_[i], end);
  }
  for (std::size_t c = 0; c < components_.size(); ++c) {
    const auto [joint, direction] = components_[c];
    const auto value = [&, joint = joint, direction = direction](const GeometricErrors& e) {
      return e[joint->letter].component[direction](joint->letter, at);
    };
    numbers[tables_.base_at + c] = value(fixed_);
    for (std::uint32_t e = tables_.first_entry[c]; e < tables_.first_entry[c + 1]; ++e) {
      numbers[tables_.entries_at + e] = value(units_[tables_.column_of[e]]);
    }
  }
  return static_cast<std::uint32_t>(count_++);
}

LaneMachines LaneChain::machines(std::span<const Weights> draws) const {
  assert(!draws.empty() && draws.size() <= kLanes);
  LaneMachines machines;
  machines.weights.resize(units_.size());
  const auto draw_of = [&](std::size_t lane) -> const Weights& {
    return draws[std::min(lane, draws.size() - 1)];
  };
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (std::size_t j = 0; j < units_.size(); ++j) machines.weights[j].of[lane] = draw_of(lane)[j];
  }
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const AxisErrors& fixed = fixed_[joints_[i]->letter];
    std::array<Vec3, kLanes> places;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      AxisErrors own;
      own.location = fixed.location;
      own.carried_tilt = fixed.carried_tilt;
      for (const Location& entry : locations_) {
        if (entry.joint != i) continue;
        const double by = draw_of(lane)[entry.column] * entry.per_weight;
        if (entry.carried) {
          own.carried_tilt[entry.direction] += by;
        } else {
          own.location[entry.direction] += by;
        }
      }
      places[lane] = joints_[i]->offset + kinematics::location_shift(own);
      const auto order = machine_.rotation_order();
      const Vec3 turn = kinematics::location_turn(own);
      const bool rotary = joints_[i]->rotary();
      set(machines.joints[i].line, lane, kinematics::small_rotation(turn, order));
      set(machines.joints[i].carried, lane,
          kinematics::small_rotation(rotary ? turn : own.carried_tilt, order));
    }
    machines.joints[i].place = lanes_of(places);
  }
  return machines;
}

void LaneChain::find(const LaneMachines& machines, std::span<const std::uint32_t> places,
                     std::span<LanePose> poses) const {
  find_poses(tables_, machines, places, poses);
}

}  // namespace frustum::trials
