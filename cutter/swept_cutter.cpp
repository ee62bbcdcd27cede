#include "cutter/swept_cutter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cutter/stretch_sweep.hpp"

namespace frustum::cutter {
namespace {

using kinematics::Stretch;
using kinematics::ToolPath;

// Box of a capped cylinder around the whole cutter at one pose.
Box box_at(const ToolPose& pose, const Profile& profile) {
  const Vec3 top = pose.tip + profile.height() * pose.axis;
  const Vec3 across =
      profile.max_radius() * (Vec3::Ones() - pose.axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  return {pose.tip.cwiseMin(top) - across, pose.tip.cwiseMax(top) + across};
}

Box box_of_stretch(const ToolPose& from, const ToolPose& to, const Profile& profile) {
  const Box a = box_at(from, profile);
  const Box b = box_at(to, profile);
  // Points of the turning cutter run on arcs: at most bend/8 outside their chords.
  const double bend = StretchMotion(from, to, profile.reach()).bend() / 8.0;
  const Vec3 grow = Vec3::Constant(bend);
  return {a.min.cwiseMin(b.min) - grow, a.max.cwiseMax(b.max) + grow};
}

void append(std::vector<Interval>& all, const std::vector<SweptInterval>& found,
            std::uint32_t stretch) {
  for (const SweptInterval& i : found) {
    all.push_back({i.lo.s, i.hi.s, static_cast<EndTag>(stretch), static_cast<EndTag>(stretch)});
  }
}

}  // namespace

Result<SweptCutter> SweptCutter::sweep(ToolPath path, std::map<int, Cutter> tools) {
  for (const kinematics::PathBlock& block : path.blocks) {
    if (!tools.contains(block.tool)) {
      Diagnostic failure =
          error(fmt::format("tool T{} cuts but is not defined", block.tool),
                fmt::format("add tool.{} with type, diameter and length", block.tool));
      failure.line = static_cast<int>(block.source_line);
      return failure;
    }
  }
  return SweptCutter(std::move(path), std::move(tools));
}

SweptCutter::SweptCutter(ToolPath path, std::map<int, Cutter> tools)
    : path_(std::move(path)),
      tools_(std::make_shared<const std::map<int, Cutter>>(std::move(tools))) {
  profile_of_block_.reserve(path_.blocks.size());
  for (const auto& block : path_.blocks)
    profile_of_block_.push_back(&tools_->at(block.tool).profile());
  boxes_.reserve(path_.stretches.size());
  for (const Stretch& stretch : path_.stretches) {
    boxes_.push_back(
        box_of_stretch(path_.from(stretch), path_.to(stretch), *profile_of_block_[stretch.block]));
  }
  tree_ = std::make_shared<const CandidateTree>(boxes_);
}

const Profile& SweptCutter::profile_of(std::uint32_t stretch) const {
  return *profile_of_block_[path_.stretches[stretch].block];
}

IntervalSet SweptCutter::along(const Ray& ray, RaySpan span, std::uint32_t first_excluded) const {
  std::vector<std::uint32_t> candidates = tree_->candidates(ray, span);
  std::erase_if(candidates, [&](std::uint32_t i) { return i >= first_excluded; });

  // What the cutter covers where each stretch begins: cheap, and nearly everything.
  std::vector<Interval> standing;
  standing.reserve(candidates.size());
  for (const std::uint32_t i : candidates) {
    if (const auto chord = profile_of(i).chord(path_.from(path_.stretches[i]), ray)) {
      standing.push_back({chord->lo, chord->hi, i, i});
    }
  }
  const IntervalSet covered(standing);

  // Only stretches that may reach beyond it are solved.
  std::vector<Interval> all(covered.intervals().begin(), covered.intervals().end());
  for (const std::uint32_t i : candidates) {
    const Stretch& stretch = path_.stretches[i];
    const StretchMotion motion(path_.from(stretch), path_.to(stretch), profile_of(i).reach());
    const auto outer = profile_of(i).chord(motion.at(0.5), ray, 0.5 * motion.travel());
    if (!outer || covered.covers(outer->lo, outer->hi)) continue;
    if (outer->hi < span.lo || outer->lo > span.hi) continue;
    append(all, swept_intervals(profile_of(i), motion, ray), i);
  }
  return IntervalSet(std::move(all)).intersected(IntervalSet({{span.lo, span.hi}}));
}

IntervalSet SweptCutter::core_along(const Ray& ray, std::span<const std::uint32_t> stretches,
                                    double shrunk_by) const {
  std::vector<Interval> all;
  for (const std::uint32_t i : stretches) {
    const Stretch& stretch = path_.stretches[i];
    const Profile& profile = profile_of(i);
    const StretchMotion motion(path_.from(stretch), path_.to(stretch), profile.reach());
    const int steps = 1 + static_cast<int>(motion.travel() / (0.25 * profile.max_radius()));
    for (int k = 0; k <= steps; ++k) {
      const auto chord = profile.chord(motion.at(static_cast<double>(k) / steps), ray, -shrunk_by);
      if (chord) all.push_back({chord->lo, chord->hi, i, i});
    }
  }
  return IntervalSet(std::move(all));
}

SweepContact SweptCutter::contact(const Ray& ray, double s, std::uint32_t stretch) const {
  const Stretch& at = path_.stretches[stretch];
  const Profile& profile = profile_of(stretch);
  const StretchMotion motion(path_.from(at), path_.to(at), profile.reach());
  // The standing chord at the stretch's beginning is the fallback: it made the end if nothing else did.
  double t = 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const SweptInterval& i : swept_intervals(profile, motion, ray)) {
    if (std::abs(i.lo.s - s) < nearest) {
      nearest = std::abs(i.lo.s - s);
      t = i.lo.t;
    }
    if (std::abs(i.hi.s - s) < nearest) {
      nearest = std::abs(i.hi.s - s);
      t = i.hi.t;
    }
  }
  ToolPose pose = motion.at(t);
  Vec3 normal = profile.normal(pose, ray.at(s));
  // Where a flat face slides across the ray every time is as good as any, and rounding may have chosen
  // one at the rim, with the flank's normal. A little earlier or later the face itself is met.
  constexpr double kGrazing = 1e-3, kSameEnd = 1e-9;  // of the normal along the ray; mm
  const double step = 0.1 * profile.max_radius() / std::max(motion.travel(), 1e-9);
  for (const double beside : {std::max(0.0, t - step), std::min(1.0, t + step)}) {
    if (std::abs(normal.dot(ray.direction)) > kGrazing) break;
    const auto chord = profile.chord(motion.at(beside), ray);
    if (!chord) continue;
    if (std::min(std::abs(chord->lo - s), std::abs(chord->hi - s)) > kSameEnd) continue;
    t = beside;
    pose = motion.at(t);
    normal = profile.normal(pose, ray.at(s));
  }
  return {stretch, t, pose, normal};
}

}  // namespace frustum::cutter
