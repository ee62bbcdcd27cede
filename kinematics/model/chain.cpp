#include "kinematics/model/chain.hpp"

#include <cassert>
#include <cmath>

#include "kinematics/model/joint_motion.hpp"
#include "kinematics/model/pose_rows.hpp"

namespace frustum::kinematics {
namespace {

bool has_component_errors(const AxisErrors& errors) {
  for (const ErrorFunction& component : errors.component) {
    if (!component.is_zero()) return true;
  }
  return false;
}

// Rodrigues' formula.
Mat3 rotation_by(const Vec3& axis, const SineCosine& angle) {
  const auto [s, c] = angle;
  const double x = axis.x(), y = axis.y(), z = axis.z();
  const double vx = (1.0 - c) * x, vy = (1.0 - c) * y, vz = (1.0 - c) * z;
  Mat3 r;
  r << vx * x + c, vx * y - s * z, vx * z + s * y,  //
      vy * x + s * z, vy * y + c, vy * z - s * x,   //
      vz * x - s * y, vz * y + s * x, vz * z + c;
  return r;
}

}  // namespace

ForwardChain::ForwardChain(const Machine& machine, const GeometricErrors& errors,
                           double tool_length)
    : machine_(&machine),
      grids_(errors.has_grid() ? &errors : nullptr),
      tip_(machine.spindle_offset() - tool_length * Vec3::UnitZ()),
      table_(machine.table_offset()),
      order_(machine.rotation_order()),
      frame_(machine.rotary_error_frame()) {
  for (const auto* chain : {&machine.tool_chain(), &machine.work_chain()}) {
    bool end_is_needed = false;
    for (const Joint& joint : *chain) {
      assert(count_ < kMostJoints);
      end_is_needed = end_is_needed || joint.functional_point.at_tip;
      links_[count_].needs_end = end_is_needed;
      prepare(links_[count_++], joint, errors[joint.letter]);
    }
    if (chain == &machine.tool_chain()) tool_count_ = count_;
  }
}

bool ForwardChain::locations_only() const {
  if (grids_ != nullptr) return false;
  for (std::size_t i = 0; i < count_; ++i) {
    if (links_[i].component != nullptr) return false;
  }
  return true;
}

void ForwardChain::prepare(Link& link, const Joint& joint, const AxisErrors& errors) {
  link.letter = joint.letter;
  link.direction = joint.side * joint.direction;
  link.offset = joint.offset;
  link.place = joint.offset + location_shift(errors);
  const Vec3 orientation = location_turn(errors);
  const Vec3& carried = joint.rotary() ? orientation : errors.carried_tilt;
  link.carries = !carried.isZero(0.0);
  if (link.carries) link.carried = small_rotation(carried, order_);
  link.tilted = !joint.rotary() && !orientation.isZero(0.0);
  if (link.tilted) link.line = small_rotation(orientation, order_);
  if (has_component_errors(errors)) link.component = &errors;
  link.point = joint.functional_point.point;
  link.pivot = joint.functional_point.at_tip ? Pivot::end
               : link.point.isZero(0.0)      ? Pivot::origin
                                             : Pivot::point;
  const auto along = [&](int i) { return std::abs(joint.direction[i]) == 1.0; };
  link.motion = !joint.rotary() ? Motion::linear
                : along(0)      ? Motion::about_x
                : along(1)      ? Motion::about_y
                : along(2)      ? Motion::about_z
                                : Motion::about_any;
}

void ForwardChain::rotate(const Link& link, const SineCosine& q, PoseRows& pose) {
  switch (link.motion) {
    case Motion::about_x:
      return pose.turn_x({q.sine * link.direction.x(), q.cosine});
    case Motion::about_y:
      return pose.turn_y({q.sine * link.direction.y(), q.cosine});
    case Motion::about_z:
      return pose.turn_z({q.sine * link.direction.z(), q.cosine});
    default:
      return pose.turn(rotation_by(link.direction, q));
  }
}

void ForwardChain::turn_about_pivot(const Link& link, const Vec3& turn, const Vec3& end,
                                    PoseRows& pose) const {
  if (link.pivot == Pivot::origin) return pose.turn(turn, order_);
  const Vec3& pivot = link.pivot == Pivot::end ? end : link.point;
  pose.shift(-pivot);
  pose.turn(turn, order_);
  pose.shift(pivot);
}

void ForwardChain::place(const Link& link, PoseRows& pose) {
  if (link.carries) pose.turn(link.carried);
  pose.shift(link.place);
}

void ForwardChain::prepend_linear(const Link& link, const AxisState& at, Vec3& end,
                                  PoseRows& pose) const {
  if (link.component != nullptr) {
    const ComponentErrors e = component_errors(*link.component, link.letter, at);
    turn_about_pivot(link, e.turn, end, pose);
    pose.shift(e.shift);
  }
  const Vec3 motion = at.q[link.letter] * link.direction;
  if (link.tilted) {
    const Vec3 pivot = link.pivot == Pivot::end ? end : link.point;
    pose.shift(link.line * (motion + pivot) - pivot);
  } else {
    pose.shift(motion);
  }
  place(link, pose);
  if (link.needs_end) end += motion + link.offset;
}

void ForwardChain::prepend_rotary(const Link& link, const AxisState& at, Vec3& end,
                                  PoseRows& pose) const {
  const double q = at.q[link.letter];
  const SineCosine angle{std::sin(q), std::cos(q)};
  ComponentErrors e;
  if (link.component != nullptr) e = component_errors(*link.component, link.letter, at);
  const bool rotor = frame_ == RotaryErrorFrame::rotor;
  if (rotor && link.component != nullptr) {
    pose.shift(e.shift);
    turn_about_pivot(link, e.turn, end, pose);
  }
  rotate(link, angle, pose);
  if (link.needs_end) end = rotation_by(link.direction, angle) * end;
  if (!rotor && link.component != nullptr) {
    turn_about_pivot(link, e.turn, end, pose);
    pose.shift(e.shift);
  }
  place(link, pose);
  if (link.needs_end) end += link.offset;
}

void ForwardChain::move_by_grid(const AxisState& at, PoseRows& pose) const {
  const GridErrors grid = grids_->grid_at(at.q);
  const Vec3 pivot = grid_pivot(error_frames(machine_->tool_chain(), frame_, at.q, tip_));
  pose.shift(-pivot);
  pose.turn(grid.turn, order_);
  pose.shift(pivot + grid.shift);
}

PoseRows ForwardChain::walk(std::span<const Link> links, const Vec3& end,
                            const AxisState& at) const {
  PoseRows pose(end);
  Vec3 nominal_end = end;
  for (std::size_t i = links.size(); i-- > 0;) {
    if (links[i].motion == Motion::linear) {
      prepend_linear(links[i], at, nominal_end, pose);
    } else {
      prepend_rotary(links[i], at, nominal_end, pose);
    }
  }
  return pose;
}

PoseRows ForwardChain::tool_rows(const AxisState& at) const {
  PoseRows pose = walk({links_.data(), tool_count_}, tip_, at);
  if (grids_ != nullptr) move_by_grid(at, pose);
  return pose;
}
PoseRows ForwardChain::table_rows(const AxisState& at) const {
  return walk({links_.data() + tool_count_, count_ - tool_count_}, table_, at);
}

Pose ForwardChain::bed_from_tool(const AxisState& at) const { return tool_rows(at).pose(); }
Pose ForwardChain::bed_from_table(const AxisState& at) const { return table_rows(at).pose(); }
Pose ForwardChain::table_from_tool(const AxisState& at) const {
  PoseRows tool = tool_rows(at);
  const Pose table = bed_from_table(at);
  tool.shift(-table.translation);
  tool.turn(Mat3(table.rotation.transpose()));
  return tool.pose();
}

Pose nominal_pose(const Machine& machine, const AxisPositions& q, double tool_length) {
  static const GeometricErrors none;
  return ForwardChain(machine, none, tool_length).table_from_tool(q);
}

Pose actual_pose(const Machine& machine, const GeometricErrors& errors, const AxisState& at,
                 double tool_length) {
  return ForwardChain(machine, errors, tool_length).table_from_tool(at);
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
        // Moving the work by -q shows the same tip displacement, in the work, as moving the tool by
        // +q.
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
