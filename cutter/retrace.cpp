#include "cutter/retrace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cutter/stretch_sweep.hpp"

namespace frustum::cutter {
namespace {

using kinematics::ToolPath;

// Stretches on each side of the contact that planes are held against.
constexpr std::uint32_t kWindow = 40;
// And how far from its own stretch a contact is followed.
constexpr std::uint32_t kFollowed = 3;
// What a plane may cut off beyond the contact, normal to the surface (mm).
constexpr double kTolerance = kSearchTolerance;

// The stretches in a row, each beginning where the one before ends, in blocks of one tool.
bool follows(const ToolPath& path, std::uint32_t i) {
  const auto& before = path.stretches[i];
  const auto& after = path.stretches[i + 1];
  return after.first_pose == before.first_pose + 1 &&
         path.blocks[before.block].tool == path.blocks[after.block].tool;
}

// Whether the plane, made at the pose before or after poses [first, last), keeps the cutter at all of
// them and on the ways between off the point x. `departure`: how much less than linear the distance of the
// plane may be between two poses; the plane's own pose is at least at distance 0.
bool holds_back(const TouchingPlane& plane, const ToolPath& path, std::size_t first,
                std::size_t last, const Vec3& x, double departure) {
  const double enough = plane.offset + std::max(0.0, 4.0 * departure - kTolerance);
  for (std::size_t i = first; i < last; ++i) {
    const kinematics::ToolPose& pose = path.poses[i];
    const Vec3 v = x - pose.tip;
    const double q = plane.side.dot(pose.axis);
    const double along = v.dot(pose.axis);
    // The side made normal to this axis, (side - q axis) / sqrt(1 - q^2); the series for the root falls
    // short by less than q^6.
    const double q2 = q * q;
    const double across = (plane.side.dot(v) - q * along) * (1.0 + q2 * (0.5 + 0.375 * q2));
    const double distance = plane.axial * along + plane.lateral * across;
    if (distance - q2 * q2 * q2 * std::abs(across) < enough) return false;
  }
  return true;
}

}  // namespace

ContactTrail trail_of(const SweptCutter& nominal, const Ray& ray, double start,
                      const SweepContact& contact) {
  ContactTrail trail{.ray = ray,
                     .start = start,
                     .contact = contact,
                     .first = contact.stretch,
                     .last = contact.stretch};
  const ToolPath& path = nominal.path();
  if (!nominal.tool(path.blocks[path.stretches[contact.stretch].block].tool).body().is_convex()) {
    return trail;
  }
  while (trail.first > 0 && contact.stretch - trail.first < kWindow &&
         follows(path, trail.first - 1)) {
    --trail.first;
  }
  while (trail.last + 1 < path.stretches.size() && trail.last - contact.stretch < kWindow &&
         follows(path, trail.last)) {
    ++trail.last;
  }
  constexpr double kFar = 1.0;  // mm
  trail.clearance =
      std::max(0.0, nominal.clearance(ray.at(contact.s), trail.first, trail.last, kFar));
  return trail;
}

Result<ChangedPath> ChangedPath::on(const SweptCutter& nominal, ToolPath path) {
  const ToolPath& old = nominal.path();
  const auto same_stretch = [](const kinematics::Stretch& a, const kinematics::Stretch& b) {
    return a.first_pose == b.first_pose && a.block == b.block;
  };
  const auto same_tool = [](const kinematics::PathBlock& a, const kinematics::PathBlock& b) {
    return a.tool == b.tool;
  };
  const bool alike = path.poses.size() == old.poses.size() &&
                     std::ranges::equal(path.stretches, old.stretches, same_stretch) &&
                     std::ranges::equal(path.blocks, old.blocks, same_tool);
  if (!alike) {
    return error(
        fmt::format("the changed tool path has {} stretches in {} blocks, the nominal one {} in {}",
                    path.stretches.size(), path.blocks.size(), old.stretches.size(),
                    old.blocks.size()),
        "contacts are followed only onto a path with the same stretches, blocks and tools");
  }
  double displacement = 0.0, departure = 0.0;
  for (const kinematics::Stretch& stretch : path.stretches) {
    const double reach = nominal.tool(path.blocks[stretch.block].tool).body().reach();
    for (const std::uint32_t i : {stretch.first_pose, stretch.first_pose + 1}) {
      const double moved = (path.poses[i].tip - old.poses[i].tip).norm() +
                           reach * (path.poses[i].axis - old.poses[i].axis).norm();
      displacement = std::max(displacement, moved);
    }
    const StretchMotion motion(path.from(stretch), path.to(stretch), reach);
    departure = std::max(departure,
                         0.125 * motion.turn() * (motion.turn() * reach + 2.0 * motion.travel()));
  }
  return ChangedPath(nominal, std::move(path), displacement, departure);
}

ChangedPath::ChangedPath(const SweptCutter& nominal, ToolPath path, double displacement,
                         double departure)
    : path_(std::move(path)),
      nominal_(nominal),
      displacement_(displacement),
      departure_(departure) {
  body_of_block_.reserve(path_.blocks.size());
  for (const auto& block : path_.blocks)
    body_of_block_.push_back(&nominal_.tool(block.tool).body());
}

std::optional<SweepContact> ChangedPath::follow(const ContactTrail& trail) const {
  if (!(trail.clearance > 0.0)) return std::nullopt;
  const std::uint32_t own = trail.contact.stretch;
  const Body& body = *body_of_block_[path_.stretches[own].block];
  const Profile& part = body.parts().front();
  const auto pose_before = [&](std::uint32_t i) { return path_.stretches[i].first_pose; };

  // The stretches to solve: more of them on the side where the plane does not hold the others back.
  std::uint32_t first = own, last = own, best_stretch = own;
  SweptEnd best{.s = -std::numeric_limits<double>::infinity()};
  std::optional<TouchingPlane> left, right;
  const auto solve = [&](std::uint32_t i) {
    const StretchMotion motion(path_.poses[pose_before(i)], path_.poses[pose_before(i) + 1],
                               body.reach());
    const auto exit = last_exit(part, motion, trail.ray);
    if (!exit) return false;
    if (exit->end.s > best.s) {
      best = exit->end;
      best_stretch = i;
    }
    if (i == first) left = exit->at_begin;
    if (i == last) right = exit->at_end;
    return true;
  };
  if (!solve(own)) return std::nullopt;
  for (;;) {
    const Vec3 x = trail.ray.at(best.s);
    if (!holds_back(*left, path_, pose_before(trail.first), pose_before(first) - 1, x,
                    departure_)) {
      if (first == trail.first || own - first == kFollowed) return std::nullopt;
      --first;
      if (!solve(first)) return std::nullopt;
    } else if (!holds_back(*right, path_, pose_before(last) + 2, pose_before(trail.last) + 2, x,
                           departure_)) {
      if (last == trail.last || last - own == kFollowed) return std::nullopt;
      ++last;
      if (!solve(last)) return std::nullopt;
    } else {
      break;
    }
  }

  // The cutter itself must clear the way from the start, and no other stretch may come near.
  const StretchMotion motion(path_.poses[pose_before(best_stretch)],
                             path_.poses[pose_before(best_stretch) + 1], body.reach());
  const ToolPose pose = motion.at(best.t);
  const auto cleared = part.chord(pose, trail.ray);
  if (!cleared || cleared->lo > trail.start) return std::nullopt;
  if (std::abs(best.s - trail.contact.s) + displacement_ >= trail.clearance) return std::nullopt;
  const Vec3 normal = part.normal_of(best.face, pose, trail.ray.at(best.s));
  return SweepContact{best.s, best_stretch, 0, best.face, best.t, pose, normal};
}

}  // namespace frustum::cutter
