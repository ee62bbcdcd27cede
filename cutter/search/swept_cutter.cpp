#include "cutter/search/swept_cutter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "cutter/search/front_search.hpp"
#include "cutter/search/ray_tile.hpp"
#include "cutter/sweep/concave_sweep.hpp"
#include "cutter/sweep/segment_sweep.hpp"
#include "cutter/sweep/swept_box.hpp"

namespace frustum::cutter {
namespace {

using kinematics::PathSegment;
using kinematics::ToolPath;

constexpr double kPassedOver = 1e-9;  // mm
// Of the radius of a ball: ends nearer to each other share what holds groups back.
constexpr double kFanned = 0.2;

// Least distance between a point and the body moving through it, or `least` if that is less; at
// most kCoarse too small. No point of the body is faster than the motion says.
class LeastDistance {
 public:
  LeastDistance(const Body& body, const SegmentMotion& motion, const Vec3& point, double least)
      : body_(body), motion_(motion), point_(point), least_(least) {}

  [[nodiscard]] double value() {
    search(0.0, at(0.0), 1.0, at(1.0));
    return least_;
  }

 private:
  static constexpr double kCoarse = 1e-3;  // mm

  [[nodiscard]] double at(double t) const { return body_.distance(motion_.at(t), point_); }

  void search(double t0, double d0, double t1, double d1) {
    const double way = motion_.travel() * (t1 - t0);
    const double bound = 0.5 * (d0 + d1 - way);
    if (bound >= least_) return;
    if (way < 2.0 * kCoarse) {
      least_ = bound;
      return;
    }
    const double middle = 0.5 * (t0 + t1), d = at(middle);
    search(t0, d0, middle, d);
    search(middle, d, t1, d1);
  }

  const Body& body_;
  const SegmentMotion& motion_;
  const Vec3& point_;
  double least_;
};

// Of what is covered, within the span; gaps of rounding are passed over.
IntervalSet intervals_of(std::span<const SweptInterval> cover, const RaySpan& span) {
  std::vector<Interval> all;
  all.reserve(cover.size());
  for (const SweptInterval& c : cover) {
    const auto lo_tag = static_cast<EndTag>(c.lo.segment),
               hi_tag = static_cast<EndTag>(c.hi.segment);
    if (!all.empty() && c.lo.s - all.back().hi < kPassedOver) {
      all.back().hi = c.hi.s;
      all.back().hi_tag = hi_tag;
    } else {
      all.push_back({c.lo.s, c.hi.s, lo_tag, hi_tag});
    }
  }
  return IntervalSet(std::move(all)).intersected(IntervalSet({{span.lo, span.hi}}));
}

// Groups of a tool that may cover anything in a ball.
class NearGroups {
 public:
  NearGroups(const ToolPath& path, const ToolSweep& sweep, const SweptNear& ball,
             std::uint32_t first_excluded, std::vector<std::uint32_t>& found)
      : path_(path), sweep_(sweep), ball_(ball), first_excluded_(first_excluded), found_(found) {}

  void add(std::uint32_t index) {
    if (sweep_.tree.is_free(index)) return;
    const PoseGroup group = sweep_.tree.group(index);
    if (is_away(group)) return;
    if (group.count > 0 || group.shift <= kCoarsest * ball_.radius) {
      found_.push_back(index);
      return;
    }
    for (std::uint32_t k = 0; k < kSiblings; ++k) add(group.children + k);
  }

 private:
  // Of the radius of the ball: larger groups are divided.
  static constexpr double kCoarsest = 0.5;

  [[nodiscard]] bool is_away(const PoseGroup& group) const {
    if (group.earliest >= first_excluded_) return true;
    const Vec3 beyond = (group.box.min - ball_.centre)
                            .cwiseMax(ball_.centre - group.box.max)
                            .cwiseMax(Vec3::Zero());
    return beyond.squaredNorm() > ball_.radius * ball_.radius ||
           sweep_.body->distance(group.representative(path_), ball_.centre) - group.shift >
               ball_.radius;
  }

  const ToolPath& path_;
  const ToolSweep& sweep_;
  const SweptNear& ball_;
  std::uint32_t first_excluded_;
  std::vector<std::uint32_t>& found_;
};

double accuracy_of(const Body& body) {
  const double convex = 2.0 * kSearchTolerance + kMissedDepth;
  return body.concave().empty() ? convex : convex + concave_accuracy(body);
}

}  // namespace

Result<SweptCutter> SweptCutter::sweep(ToolPath path, std::map<int, Cutter> tools) {
  for (const kinematics::PathBlock& block : path.blocks) {
    if (!tools.contains(block.tool)) {
      Diagnostic failure =
          error("unknown-tool"_id, fmt::format("tool T{} cuts but is not defined", block.tool),
                fmt::format("add tool.{} with type, diameter and length", block.tool));
      failure.line = static_cast<int>(block.source_line);
      return failure;
    }
  }
  if (const auto fault = half_turn(path)) return *fault;
  return SweptCutter(std::move(path), std::move(tools));
}

SweptCutter::SweptCutter(ToolPath path, std::map<int, Cutter> tools)
    : path_(std::move(path)),
      tools_(std::make_shared<const std::map<int, Cutter>>(std::move(tools))) {
  std::map<int, std::vector<std::uint32_t>> segments_of_tool;
  for (std::uint32_t i = 0; i < path_.segments.size(); ++i) {
    segments_of_tool[path_.blocks[path_.segments[i].block].tool].push_back(i);
  }
  std::vector<ToolSweep> sweeps;
  for (auto& [number, segments] : segments_of_tool) {
    const Body& body = tools_->at(number).body();
    accuracy_ = std::max(accuracy_, accuracy_of(body));
    sweeps.push_back({.body = &body, .tree = PoseTree(path_, std::move(segments), body)});
  }
  sweeps_ = std::make_shared<const std::vector<ToolSweep>>(std::move(sweeps));
}

const Body& SweptCutter::body_of(std::uint32_t segment) const {
  return tools_->at(path_.blocks[path_.segments[segment].block].tool).body();
}

Box SweptCutter::box(std::uint32_t segment) const {
  const Body& body = body_of(segment);
  return swept_box({0.0, body.height(), body.max_radius()},
                   SegmentMotion(path_, path_.segments[segment], body.reach()));
}

IntervalSet SweptCutter::along(const Ray& ray, RaySpan span, std::uint32_t first_excluded) const {
  const RayQuestion question{&path_, ray, span, first_excluded};
  std::vector<SweptInterval> cover;
  for (const ToolSweep& sweep : *sweeps_) extend_swept_interval(question, sweep, cover);
  return intervals_of(cover, span);
}

std::vector<IntervalSet> SweptCutter::along_all(std::span<const Ray> rays,
                                                std::span<const RaySpan> spans, std::size_t row,
                                                std::uint32_t first_excluded) const {
  std::vector<IntervalSet> all(rays.size());
  const bool convex = std::ranges::all_of(
      *sweeps_, [](const ToolSweep& sweep) { return sweep.body->concave().empty(); });
  if (!convex) {
    for (std::size_t r = 0; r < rays.size(); ++r) {
      if (spans[r].lo <= spans[r].hi) all[r] = along(rays[r], spans[r], first_excluded);
    }
    return all;
  }
  std::vector<std::vector<SweptInterval>> cover(rays.size());
  const TileQuestion question{&path_, tools_.get(), rays, spans, row, first_excluded};
  for (const ToolSweep& sweep : *sweeps_) extend_swept_intervals(question, sweep, cover);
  for (std::size_t r = 0; r < rays.size(); ++r) {
    if (!cover[r].empty()) all[r] = intervals_of(cover[r], spans[r]);
  }
  return all;
}
std::optional<SweepContact> SweptCutter::end_of_void(const Ray& ray, double from, double to,
                                                     std::uint32_t first_excluded) const {
  return end_of_void(ray, from, to, {}, first_excluded);
}

std::optional<SweepContact> SweptCutter::end_of_void(const Ray& ray, double from, double to,
                                                     const Likely& likely,
                                                     std::uint32_t first_excluded) const {
  const RayQuestion question{&path_, ray, {from, to}, first_excluded};
  SweptIntervalEnd front{.s = from};
  bool moved = false;
  const bool is_unknown = likely.segments.empty() && likely.near == nullptr;
  const auto tools = sweeps_->size();
  // Until no tool has moved it since all the others were asked.
  std::size_t still = 0;
  for (std::size_t tool = 0; still < tools; tool = (tool + 1) % tools) {
    ++still;
    const bool moves = is_unknown ? advance_front(question, (*sweeps_)[tool], kPassedOver, front)
                                  : advance_front_near(question, tool, likely, front);
    if (!moves) continue;
    moved = true;
    still = 1;
  }
  if (!moved) return std::nullopt;
  return contact_of(ray, front);
}

bool SweptCutter::advance_front_near(const RayQuestion& question, std::size_t tool,
                                     const Likely& likely, SweptIntervalEnd& front) const {
  const ToolSweep& sweep = (*sweeps_)[tool];
  constexpr std::uint32_t kRoot = 0;
  const std::span<const std::uint32_t> groups =
      likely.near != nullptr ? std::span<const std::uint32_t>(likely.near->groups[tool])
                             : std::span(&kRoot, 1);
  if (groups.empty() || sweep.tree.empty()) return false;
  constexpr std::size_t kMostFirst = 4;
  std::array<std::uint32_t, kMostFirst> first{};
  std::size_t count = 0;
  for (const EndTag tag : likely.segments) {
    if (tag < 0 || tag >= static_cast<EndTag>(question.first_excluded) || count == kMostFirst)
      continue;
    const auto segment = static_cast<std::uint32_t>(tag);
    if (&body_of(segment) == sweep.body) first[count++] = segment;
  }
  EndFans* fans = likely.near != nullptr ? &likely.near->fans[tool] : nullptr;
  return advance_front(question, sweep, kPassedOver, groups, std::span(first).first(count), fans,
                       front);
}

bool SweptNear::empty() const {
  return std::ranges::all_of(groups, [](const auto& tool) { return tool.empty(); });
}

SweptNear SweptCutter::near(const Vec3& centre, double radius, std::uint32_t first_excluded,
                            const SweptNear* within) const {
  SweptNear near{.centre = centre, .radius = radius};
  near.groups.resize(sweeps_->size());
  near.fans.assign(sweeps_->size(), EndFans(kFanned * radius));
  constexpr std::uint32_t kRoot = 0;
  for (std::size_t tool = 0; tool < sweeps_->size(); ++tool) {
    const ToolSweep& sweep = (*sweeps_)[tool];
    if (sweep.tree.empty()) continue;
    NearGroups found(path_, sweep, near, first_excluded, near.groups[tool]);
    const auto groups = within != nullptr ? std::span<const std::uint32_t>(within->groups[tool])
                                          : std::span(&kRoot, 1);
    for (const std::uint32_t group : groups) found.add(group);
  }
  return near;
}

SweepContact SweptCutter::contact_of(const Ray& ray, const SweptIntervalEnd& end) const {
  const PathSegment& at = path_.segments[end.segment];
  const Body& body = body_of(end.segment);
  return sweep_contact(body, SegmentMotion(path_, at, body.reach()), ray, end);
}

IntervalSet SweptCutter::core_along(const Ray& ray, std::span<const std::uint32_t> segments,
                                    double shrunk_by) const {
  std::vector<Interval> all;
  for (const std::uint32_t i : segments) {
    const PathSegment& segment = path_.segments[i];
    const Body& body = body_of(i);
    const SegmentMotion motion(path_, segment, body.reach());
    const int steps = 1 + static_cast<int>(motion.travel() / (0.25 * body.max_radius()));
    for (int k = 0; k <= steps; ++k) {
      for (const Chord& c : body.core(motion.at(static_cast<double>(k) / steps), ray, shrunk_by)) {
        all.push_back({c.lo, c.hi, i, i});
      }
    }
  }
  return IntervalSet(std::move(all));
}

SweepContact SweptCutter::contact(const Ray& ray, double s, std::uint32_t segment) const {
  const PathSegment& at = path_.segments[segment];
  const Body& body = body_of(segment);
  const SegmentMotion motion(path_, at, body.reach());
  constexpr double kSameEnd = 1e-6;  // mm
  SweptIntervalEnd end{.s = s, .segment = segment};
  double nearest = std::numeric_limits<double>::infinity();
  if (body.is_convex()) {
    const auto only = swept_end_at(body.sections().front(), motion, ray, s);
    if (only && std::abs(only->s - s) <= kSameEnd)
      return contact_of(ray, {s, segment, 0, only->t, only->face});
  }
  const ConcaveSweep concave(body, motion, ray);
  const bool is_whole = body.concave().empty() || !concave.slides();
  const std::size_t solved = is_whole ? body.sections().size() : body.parts().size();
  for (std::uint32_t section = 0; section < solved; ++section) {
    for (const SegmentInterval& i : swept_intervals(body.sections()[section], motion, ray)) {
      for (const SweptEnd& e : {i.lo, i.hi}) {
        if (std::abs(e.s - s) >= nearest) continue;
        if (section >= body.parts().size() && !concave.is_of_body(e)) continue;
        nearest = std::abs(e.s - s);
        end = {s, segment, section, e.t, e.face};
      }
    }
  }
  // A concave face, or a ray that grazes: then any end may be the one that rounding has chosen.
  const double same = body.concave().empty() ? kSameEnd : kSearchTolerance;
  if (nearest > same) {
    end.section = kConcaveSurface;
    end.t = concave.nearest_state(s);
  }
  return contact_of(ray, end);
}

double SweptCutter::clearance(const Vec3& point, std::uint32_t first, std::uint32_t last,
                              double enough) const {
  double least = enough;
  for (const ToolSweep& sweep : *sweeps_) {
    std::vector<std::uint32_t> open;
    if (!sweep.tree.empty()) open.push_back(0);
    while (!open.empty()) {
      const std::uint32_t index = open.back();
      open.pop_back();
      const PoseGroup group = sweep.tree.group(index);
      const Vec3 beyond =
          (group.box.min - point).cwiseMax(point - group.box.max).cwiseMax(Vec3::Zero());
      if (beyond.norm() >= least) continue;
      const double distance = sweep.body->distance(group.representative(path_), point);
      if (distance - group.shift >= least) continue;
      if (group.count == 0) {
        for (std::uint32_t k = kSiblings; k-- > 0;) {
          if (!sweep.tree.is_free(group.children + k)) open.push_back(group.children + k);
        }
        continue;
      }
      for (const std::uint32_t i : sweep.tree.segments().subspan(group.first, group.count)) {
        if (i >= first && i <= last) continue;
        const PathSegment& segment = path_.segments[i];
        const SegmentMotion motion(path_, segment, sweep.body->reach());
        least = LeastDistance(*sweep.body, motion, point, least).value();
      }
    }
  }
  return least;
}

}  // namespace frustum::cutter
