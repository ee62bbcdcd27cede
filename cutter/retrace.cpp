#include "cutter/retrace.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cutter/end_guard.hpp"
#include "cutter/stretch_sweep.hpp"

namespace frustum::cutter {
namespace {

using kinematics::ToolPath;

// A cutter that stands this far from the contact is outside of the window (mm).
constexpr double kBeside = 0.1;
// And so are more stretches than these on each side of it.
constexpr std::uint32_t kWindow = 40;
// How far from its own stretch a contact is followed.
constexpr std::uint32_t kFollowed = 3;

// The stretches in a row, each beginning where the one before ends, in blocks of one tool.
bool follows(const ToolPath& path, std::uint32_t i) {
  const auto& before = path.stretches[i];
  const auto& after = path.stretches[i + 1];
  return after.first_pose == before.first_pose + 1 &&
         path.blocks[before.block].tool == path.blocks[after.block].tool;
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
  const Body& body = nominal.tool(path.blocks[path.stretches[contact.stretch].block].tool).body();
  if (!body.is_convex()) return trail;
  const Vec3 point = ray.at(contact.s);
  const auto beside = [&](std::uint32_t pose) {
    return body.distance(path.poses[pose], point) > kBeside;
  };
  while (trail.first > 0 && contact.stretch - trail.first < kWindow &&
         follows(path, trail.first - 1) && !beside(path.stretches[trail.first].first_pose)) {
    --trail.first;
  }
  while (trail.last + 1 < path.stretches.size() && trail.last - contact.stretch < kWindow &&
         follows(path, trail.last) && !beside(path.stretches[trail.last].first_pose + 1)) {
    ++trail.last;
  }
  constexpr double kFar = 1.0;  // mm
  trail.clearance = std::max(0.0, nominal.clearance(point, trail.first, trail.last, kFar));
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
  if (const auto fault = half_turn(path)) return *fault;
  double displacement = 0.0;
  std::vector<double> departures;
  departures.reserve(path.stretches.size());
  for (const kinematics::Stretch& stretch : path.stretches) {
    const double reach = nominal.tool(path.blocks[stretch.block].tool).body().reach();
    const StretchMotion motion(path, stretch, reach);
    const StretchMotion before(old, stretch, reach);
    // Between the poses the axes turn evenly, which spreads them where the turn is large.
    const double spread = 1.0 / std::cos(0.5 * std::max(motion.turn(), before.turn()));
    for (const std::uint32_t i : {stretch.first_pose, stretch.first_pose + 1}) {
      const double moved = (path.poses[i].tip - old.poses[i].tip).norm() +
                           spread * reach * (path.poses[i].axis - old.poses[i].axis).norm();
      displacement = std::max(displacement, moved);
    }
    constexpr double kFarTurned = 0.05;  // plane_departure() holds up to here
    const double departure = motion.plane_departure(1.0, reach + motion.travel(), motion.travel());
    departures.push_back(motion.turn() > kFarTurned ? std::numeric_limits<double>::infinity()
                                                    : 4.0 * departure);
  }
  return ChangedPath(nominal.tools(), std::move(path), displacement, std::move(departures));
}

ChangedPath::ChangedPath(std::shared_ptr<const std::map<int, Cutter>> tools, ToolPath path,
                         double displacement, std::vector<double> departures)
    : path_(std::move(path)),
      tools_(std::move(tools)),
      displacement_(displacement),
      departures_(std::move(departures)) {
  body_of_block_.reserve(path_.blocks.size());
  for (const auto& block : path_.blocks) body_of_block_.push_back(&tools_->at(block.tool).body());
}

// The stretches beside those that were solved, up to the end of the window. The plane that touches the cutter
// where the two sides part holds the nearest one back: it touches one end of it, so that its distance, less
// than linear by at most a quarter of what it is at the other end, stays. The others each have their own plane.
bool ChangedPath::holds_back(const TouchingPlane& plane, const EndGuard& end, const Vec3& point,
                             const Side& side) const {
  const auto pose_beyond = [&](std::uint32_t stretch) -> const ToolPose& {
    return path_.poses[path_.stretches[stretch].first_pose + (side.up ? 1U : 0U)];
  };
  for (std::uint32_t count = 0, i = side.from; count < side.count; ++count, side.up ? ++i : --i) {
    if (count == 0) {
      if (!(plane.height(pose_beyond(i), point) >= departures_[i])) return false;
    } else if (!end.holds(motion_of(i))) {
      return false;
    }
  }
  return true;
}

StretchMotion ChangedPath::motion_of(std::uint32_t stretch) const {
  const auto& at = path_.stretches[stretch];
  return {path_, at, body_of_block_[at.block]->reach()};
}

std::optional<SweepContact> ChangedPath::follow(const ContactTrail& trail) const {
  if (!(trail.clearance > 0.0)) return std::nullopt;
  const std::uint32_t own = trail.contact.stretch;
  const Body& body = *body_of_block_[path_.stretches[own].block];
  const Profile& part = body.parts().front();

  // The stretches to solve: more of them on the side that is not held back.
  std::uint32_t first = own, last = own;
  CoverEnd best{.s = -std::numeric_limits<double>::infinity()};
  std::optional<TouchingPlane> left, right;
  const auto solve = [&](std::uint32_t i) {
    const auto exit = last_exit(part, motion_of(i), trail.ray);
    if (!exit) return false;
    if (exit->end.s > best.s) best = {exit->end.s, i, 0, exit->end.t, exit->end.face};
    if (i == first) left = exit->at_begin;
    if (i == last) right = exit->at_end;
    return true;
  };
  if (!solve(own)) return std::nullopt;
  for (;;) {
    const Vec3 point = trail.ray.at(best.s);
    const ToolPose pose = motion_of(best.stretch).at(best.t);
    const EndGuard end(body, trail.ray, {best.s, best.slab, best.face, pose}, true);
    if (!holds_back(*left, end, point, {first - 1, first - trail.first, false})) {
      if (first == trail.first || own - first == kFollowed) return std::nullopt;
      --first;
      if (!solve(first)) return std::nullopt;
    } else if (!holds_back(*right, end, point, {last + 1, trail.last - last, true})) {
      if (last == trail.last || last - own == kFollowed) return std::nullopt;
      ++last;
      if (!solve(last)) return std::nullopt;
    } else {
      break;
    }
  }

  // The cutter itself must clear the way from the start, and no other stretch may come near.
  const StretchMotion motion = motion_of(best.stretch);
  const auto cleared = part.chord(motion.at(best.t), trail.ray);
  if (!cleared || cleared->lo > trail.start) return std::nullopt;
  if (std::abs(best.s - trail.contact.s) + displacement_ >= trail.clearance) return std::nullopt;
  return sweep_contact(body, motion, trail.ray, best);
}

}  // namespace frustum::cutter
