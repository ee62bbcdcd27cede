#include "kinematics/chain.hpp"

#include <cassert>
#include <cmath>

#include "kinematics/joint_motion.hpp"
#include "kinematics/small_rotation.hpp"

namespace frustum::kinematics {
namespace {

bool has_component_errors(const AxisErrors& errors) {
  for (const ErrorFunction& component : errors.component) {
    if (!component.is_zero()) return true;
  }
  return false;
}

// Rodrigues' formula.
Mat3 rotation_by(const Vec3& axis, double angle) {
  const auto [s, c] = sine_cosine(angle);
  const Vec3 v = (1.0 - c) * axis;
  Mat3 r = v * axis.transpose();
  r.diagonal().array() += c;
  r(0, 1) -= s * axis.z();
  r(1, 0) += s * axis.z();
  r(0, 2) += s * axis.y();
  r(2, 0) -= s * axis.y();
  r(1, 2) -= s * axis.x();
  r(2, 1) += s * axis.x();
  return r;
}

}  // namespace

ForwardChain::ForwardChain(const Machine& machine, const GeometricErrors& errors,
                           double tool_length)
    : tip_(machine.spindle_offset() - tool_length * Vec3::UnitZ()),
      table_(machine.table_offset()),
      order_(machine.rotation_order()),
      frame_(machine.rotary_error_frame()) {
  for (const auto* chain : {&machine.tool_chain(), &machine.work_chain()}) {
    for (const Joint& joint : *chain) {
      assert(count_ < kMostJoints);
      links_[count_++] = link(joint, errors[joint.letter], order_);
    }
    if (chain == &machine.tool_chain()) tool_count_ = count_;
  }
}

ForwardChain::Link ForwardChain::link(const Joint& joint, const AxisErrors& errors,
                                      RotationOrder order) {
  Link link{.letter = joint.letter, .rotary = joint.rotary()};
  link.direction = joint.side * joint.direction;
  link.offset = joint.offset;
  const Vec3 orientation = location_turn(errors);
  const Vec3& placed = link.rotary ? orientation : errors.carried_tilt;
  link.place = {small_rotation(placed, order), joint.offset + location_shift(errors)};
  link.turned = !placed.isZero(0.0);
  link.tilted = !link.rotary && !orientation.isZero(0.0);
  if (link.tilted) link.line = small_rotation(orientation, order);
  if (has_component_errors(errors)) link.component = &errors;
  link.point = joint.functional_point.point;
  link.pivot = joint.functional_point.at_tip ? Pivot::end
               : link.point.isZero(0.0)      ? Pivot::origin
                                             : Pivot::point;
  return link;
}

void ForwardChain::prepend_linear(const Link& link, const AxisState& at, const Vec3& nominal_end,
                                  Pose& pose) const {
  const Vec3& pivot = link.pivot == Pivot::end ? nominal_end : link.point;
  Vec3 motion = at.q[link.letter] * link.direction;
  if (link.tilted) motion = link.line * (motion + pivot) - pivot;
  if (link.component != nullptr) {
    const ComponentErrors e = component_errors(*link.component, link.letter, at);
    motion += e.shift;
    const Mat3 turn = small_rotation(e.turn, order_);
    if (link.pivot != Pivot::origin) motion += pivot - turn * pivot;
    pose.rotation = (turn * pose.rotation).eval();
    pose.translation = (turn * pose.translation).eval();
  }
  pose.translation += motion;
}

void ForwardChain::prepend_rotary(const Link& link, const Mat3& rotate, const AxisState& at,
                                  const Vec3& nominal_end, Pose& pose) const {
  if (link.component == nullptr) {
    pose.rotation = (rotate * pose.rotation).eval();
    pose.translation = (rotate * pose.translation).eval();
    return;
  }
  const Vec3& pivot = link.pivot == Pivot::end ? nominal_end : link.point;
  const ComponentErrors e = component_errors(*link.component, link.letter, at);
  const Mat3 turn = small_rotation(e.turn, order_);
  const bool rotor = frame_ == RotaryErrorFrame::rotor;
  Mat3 moved;
  if (rotor) {
    moved.noalias() = rotate * turn;
    Vec3 shift = turn * e.shift;
    if (link.pivot != Pivot::origin) shift += pivot - turn * pivot;
    pose.translation = (moved * pose.translation + rotate * shift).eval();
  } else {
    moved.noalias() = turn * rotate;
    Vec3 shift = e.shift;
    if (link.pivot != Pivot::origin) shift += pivot - turn * pivot;
    pose.translation = (moved * pose.translation + shift).eval();
  }
  pose.rotation = (moved * pose.rotation).eval();
}

// From the end of the chain back to the bed, so that the nominal place of the end, about which some
// errors turn, comes along the way.
Pose ForwardChain::walk(std::span<const Link> links, const Vec3& end, const AxisState& at) const {
  Pose pose = Pose::translated(end);
  Vec3 nominal_end = end;
  for (std::size_t i = links.size(); i-- > 0;) {
    const Link& link = links[i];
    if (link.rotary) {
      const Mat3 rotate = rotation_by(link.direction, at.q[link.letter]);
      const Vec3 turned_end = rotate * nominal_end;
      prepend_rotary(link, rotate, at,
                     frame_ == RotaryErrorFrame::stator ? turned_end : nominal_end, pose);
      nominal_end = turned_end;
    } else {
      prepend_linear(link, at, nominal_end, pose);
      nominal_end += at.q[link.letter] * link.direction;
    }
    if (link.turned) {
      pose.rotation = (link.place.rotation * pose.rotation).eval();
      pose.translation = (link.place.rotation * pose.translation).eval();
    }
    pose.translation += link.place.translation;
    nominal_end += link.offset;
  }
  return pose;
}

Pose ForwardChain::bed_from_tool(const AxisState& at) const {
  return walk({links_.data(), tool_count_}, tip_, at);
}

Pose ForwardChain::bed_from_table(const AxisState& at) const {
  return walk({links_.data() + tool_count_, count_ - tool_count_}, table_, at);
}

Pose ForwardChain::table_from_tool(const AxisState& at) const {
  const Pose tool = bed_from_tool(at);
  const Pose table = bed_from_table(at);
  return {table.rotation.transpose() * tool.rotation,
          table.rotation.transpose() * (tool.translation - table.translation)};
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
