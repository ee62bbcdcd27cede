#include "cutter/search/contact_continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cutter/search/separating_plane.hpp"
#include "cutter/sweep/segment_sweep.hpp"

namespace frustum::cutter {
namespace {

using kinematics::ToolPath;

// A cutter that is this far from the contact is outside of the window (mm).
constexpr double kBeside = 0.1;
// And so are more segments than these on each side of it.
constexpr std::uint32_t kWindow = 40;
// How far from its own segment a contact is followed.
constexpr std::uint32_t kFollowed = 3;

// The segments in a row, each beginning where the one before ends, in blocks of one tool.
bool follows(const ToolPath& path, std::uint32_t i) {
  const auto& before = path.segments[i];
  const auto& after = path.segments[i + 1];
  return after.first_pose == before.first_pose + 1 &&
         path.blocks[before.block].tool == path.blocks[after.block].tool;
}

}  // namespace

ContactContinuation continuation_of(const SweptCutter& nominal, const Ray& ray, double start,
                                    const SweepContact& contact) {
  ContactContinuation continuation{.ray = ray,
                                   .start = start,
                                   .contact = contact,
                                   .first = contact.segment,
                                   .last = contact.segment};
  const ToolPath& path = nominal.path();
  const Body& body = nominal.tool(path.blocks[path.segments[contact.segment].block].tool).body();
  if (!body.is_convex()) return continuation;
  const Vec3 point = ray.at(contact.s);
  const auto beside = [&](std::uint32_t pose) {
    return body.distance(path.poses[pose], point) > kBeside;
  };
  while (continuation.first > 0 && contact.segment - continuation.first < kWindow &&
         follows(path, continuation.first - 1) &&
         !beside(path.segments[continuation.first].first_pose)) {
    --continuation.first;
  }
  while (continuation.last + 1 < path.segments.size() &&
         continuation.last - contact.segment < kWindow && follows(path, continuation.last) &&
         !beside(path.segments[continuation.last].first_pose + 1)) {
    ++continuation.last;
  }
  constexpr double kFar = 1.0;  // mm
  continuation.clearance =
      std::max(0.0, nominal.clearance(point, continuation.first, continuation.last, kFar));
  return continuation;
}

Result<ChangedPath> ChangedPath::on(const SweptCutter& nominal, ToolPath path) {
  const ToolPath& old = nominal.path();
  const auto same_segment = [](const kinematics::PathSegment& a, const kinematics::PathSegment& b) {
    return a.first_pose == b.first_pose && a.block == b.block;
  };
  const auto same_tool = [](const kinematics::PathBlock& a, const kinematics::PathBlock& b) {
    return a.tool == b.tool;
  };
  const bool alike = path.poses.size() == old.poses.size() &&
                     std::ranges::equal(path.segments, old.segments, same_segment) &&
                     std::ranges::equal(path.blocks, old.blocks, same_tool);
  if (!alike) {
    return error(
        "different-path"_id,
        fmt::format(
            "the changed tool path has {} path segments in {} blocks, the nominal one {} in {}",
            path.segments.size(), path.blocks.size(), old.segments.size(), old.blocks.size()),
        "contacts are followed only onto a path with the same path segments, blocks and tools");
  }
  if (const auto fault = half_turn(path)) return *fault;
  double displacement = 0.0;
  std::vector<double> departures;
  departures.reserve(path.segments.size());
  for (const kinematics::PathSegment& segment : path.segments) {
    const double reach = nominal.tool(path.blocks[segment.block].tool).body().reach();
    const SegmentMotion motion(path, segment, reach);
    const SegmentMotion before(old, segment, reach);
    // Between the poses the axes turn evenly, which spreads them where the turn is large.
    const double spread = 1.0 / std::cos(0.5 * std::max(motion.turn(), before.turn()));
    for (const std::uint32_t i : {segment.first_pose, segment.first_pose + 1}) {
      const double moved = (path.poses[i].tip - old.poses[i].tip).norm() +
                           spread * reach * (path.poses[i].axis - old.poses[i].axis).norm();
      displacement = std::max(displacement, moved);
    }
    constexpr double kFarTurned = 0.05;  // motions that turn by more are not followed
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

// The segments beside those that were solved, up to the end of the window. The plane that touches
// the cutter where the two sides part holds the nearest one back: it touches one end of it, so that
// its distance, less than linear by at most a quarter of what it is at the other end, stays. The
// others each have their own plane.
bool ChangedPath::holds_back(const TangentPlane& plane, const SeparatingPlane& end,
                             const Vec3& point, const Side& side) const {
  const auto pose_beyond = [&](std::uint32_t segment) -> const ToolPose& {
    return path_.poses[path_.segments[segment].first_pose + (side.up ? 1U : 0U)];
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

SegmentMotion ChangedPath::motion_of(std::uint32_t segment) const {
  const auto& at = path_.segments[segment];
  return {path_, at, body_of_block_[at.block]->reach()};
}

std::optional<SweepContact> ChangedPath::follow(const ContactContinuation& continuation) const {
  if (!(continuation.clearance > 0.0)) return std::nullopt;
  const std::uint32_t own = continuation.contact.segment;
  const Body& body = *body_of_block_[path_.segments[own].block];
  const Profile& part = body.parts().front();

  // The segments to solve: more of them on the side that is not held back.
  std::uint32_t first = own, last = own;
  SweptIntervalEnd best{.s = -std::numeric_limits<double>::infinity()};
  std::optional<TangentPlane> left, right;
  const auto solve = [&](std::uint32_t i) {
    const auto exit = last_exit(part, motion_of(i), continuation.ray);
    if (!exit) return false;
    if (exit->end.s > best.s) best = {exit->end.s, i, 0, exit->end.t, exit->end.face};
    if (i == first) left = exit->at_begin;
    if (i == last) right = exit->at_end;
    return true;
  };
  if (!solve(own)) return std::nullopt;
  for (;;) {
    const Vec3 point = continuation.ray.at(best.s);
    const ToolPose pose = motion_of(best.segment).at(best.t);
    const SeparatingPlane end(body, continuation.ray, {best.s, best.section, best.face, pose},
                              true);
    if (!holds_back(*left, end, point, {first - 1, first - continuation.first, false})) {
      if (first == continuation.first || own - first == kFollowed) return std::nullopt;
      --first;
      if (!solve(first)) return std::nullopt;
    } else if (!holds_back(*right, end, point, {last + 1, continuation.last - last, true})) {
      if (last == continuation.last || last - own == kFollowed) return std::nullopt;
      ++last;
      if (!solve(last)) return std::nullopt;
    } else {
      break;
    }
  }

  // The cutter itself must clear the way from the start, and no other segment may come near.
  const SegmentMotion motion = motion_of(best.segment);
  const auto cleared = part.chord(motion.at(best.t), continuation.ray);
  if (!cleared || cleared->lo > continuation.start) return std::nullopt;
  if (std::abs(best.s - continuation.contact.s) + displacement_ >= continuation.clearance)
    return std::nullopt;
  return sweep_contact(body, motion, continuation.ray, best);
}

}  // namespace frustum::cutter
