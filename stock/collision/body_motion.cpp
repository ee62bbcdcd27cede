#include "stock/collision/body_motion.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/model/joint_motion.hpp"

namespace frustum::stock {
namespace {

using kinematics::Joint;
using kinematics::kLinearAxes;
using kinematics::kRotaryAxes;

std::array<Vec3, 8> corners_of(const Box& box) {
  std::array<Vec3, 8> corners;
  for (std::size_t k = 0; k < 8; ++k) {
    corners.at(k) = {(k & 1U) != 0 ? box.max.x() : box.min.x(),
                     (k & 2U) != 0 ? box.max.y() : box.min.y(),
                     (k & 4U) != 0 ? box.max.z() : box.min.z()};
  }
  return corners;
}

std::size_t index_of(kinematics::AxisLetter axis) { return static_cast<std::size_t>(axis) % 3; }

}  // namespace

Pose bed_from_part(const kinematics::Machine& machine, const kinematics::MachinePart& part,
                   const AxisPositions& q) {
  const auto& chain = part.side < 0 ? machine.work_chain() : machine.tool_chain();
  Pose pose;
  for (std::size_t k = 0; k < part.joints; ++k) {
    pose = pose * kinematics::nominal_joint(chain[k], q[chain[k].letter]);
  }
  return pose;
}

BodyBranch::BodyBranch(const kinematics::Machine& machine, std::size_t from,
                       const kinematics::MachinePart& part, const Pose& part_from_body,
                       const Box& bounds)
    : last_from_body_(part_from_body) {
  const auto& chain = part.side < 0 ? machine.work_chain() : machine.tool_chain();
  for (std::size_t k = from; k < part.joints; ++k) links_.push_back({chain[k], 0.0});
  // From the body inwards: how far its points are from each joint's origin, wherever the joints in
  // between are; from the axis of the last one, exactly.
  double radius = 0.0;
  for (const Vec3& corner : corners_of(bounds)) {
    radius = std::max(radius, part_from_body.point(corner).norm());
  }
  for (std::size_t k = links_.size(); k-- > 0;) {
    Link& link = links_[k];
    if (link.joint.rotary()) {
      link.reach = radius;
      if (k + 1 == links_.size()) {
        link.reach = 0.0;
        for (const Vec3& corner : corners_of(bounds)) {
          const Vec3 p = part_from_body.point(corner);
          link.reach = std::max(link.reach, p.cross(link.joint.direction).norm());
        }
      }
      radius += link.joint.offset.norm();
    } else {
      const Vec3 along = link.joint.side * link.joint.direction;
      radius += std::max((link.joint.offset + link.joint.travel.lo * along).norm(),
                         (link.joint.offset + link.joint.travel.hi * along).norm());
    }
  }
}

Pose BodyBranch::common_from_body(const AxisPositions& q) const {
  Pose pose;
  for (const Link& link : links_) {
    pose = pose * kinematics::nominal_joint(link.joint, q[link.joint.letter]);
  }
  return pose * last_from_body_;
}

std::vector<BodyBranch::Mover> BodyBranch::movers(const AxisPositions& q) const {
  std::vector<Mover> movers;
  Mat3 turned = Mat3::Identity();
  for (const Link& link : links_) {
    const Joint& joint = link.joint;
    movers.push_back(
        {joint.letter, joint.rotary(), turned * (joint.side * joint.direction), link.reach});
    turned = turned * kinematics::nominal_joint(joint, q[joint.letter]).rotation;
  }
  return movers;
}

ClosingBound::ClosingBound(const AxisPositions& q0, std::span<const BodyBranch::Mover> a,
                           std::span<const BodyBranch::Mover> b, const Vec3* normal)
    : q0_(q0), is_directed_(normal != nullptr) {
  const auto add = [&](const BodyBranch::Mover& mover, double sign) {
    const std::size_t k = index_of(mover.axis);
    if (mover.rotary) {
      const double lever = normal == nullptr ? 1.0 : normal->cross(mover.direction).norm();
      turning_.at(k) += mover.reach * lever;
    } else {
      moving_.at(k) += sign * mover.direction;
    }
  };
  for (const BodyBranch::Mover& mover : a) add(mover, 1.0);
  for (const BodyBranch::Mover& mover : b) add(mover, -1.0);
  if (normal == nullptr) return;
  for (std::size_t k = 0; k < 3; ++k) closing_.at(k) = normal->dot(moving_.at(k));
}

double ClosingBound::at(const AxisPositions& q) const {
  double sum = 0.0;
  for (const auto axis : kRotaryAxes) {
    sum += turning_.at(index_of(axis)) * std::abs(q[axis] - q0_[axis]);
  }
  if (is_directed_) {
    for (const auto axis : kLinearAxes) sum += closing_.at(index_of(axis)) * (q[axis] - q0_[axis]);
    return sum;
  }
  Vec3 moved = Vec3::Zero();
  for (const auto axis : kLinearAxes) moved += (q[axis] - q0_[axis]) * moving_.at(index_of(axis));
  return sum + moved.norm();
}

}  // namespace frustum::stock
