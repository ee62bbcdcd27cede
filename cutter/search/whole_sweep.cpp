#include "cutter/search/whole_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace frustum::cutter {
namespace {

// Parts of a cutter that meet touch within this (mm), and so does what one pose covers: rounding of
// their ends, and twice kPoseRounding.
constexpr double kTouching = 5e-11;
// A pose's chord and the solution of the segment that begins with it differ by rounding (mm): what
// a pose covers counts for so much less.
constexpr double kPoseRounding = 1e-11;
// Bounds along the ray hold but for rounding (mm); those of planes, normal to them, but for this
// share of kSearchTolerance: 1e-12 mm.
constexpr double kBoundRounding = 1e-11;
constexpr double kRoundingShare = 0.0025;
// So much before an end a segment does not win it, however late or early it is (mm, as a slack).
constexpr double kWellBefore = -1.01 * kSearchTolerance;
// Below this cosine between the ray and a plane its rounding is too much along the ray.
constexpr double kGrazingEnd = 0.02;

// Of a place that is `depth` on the way out of what is covered.
double step_of(double depth) { return std::floor(depth * (1.0 / kSearchTolerance)); }

// What is so far before an end, or after it, says nothing of it (mm).
constexpr double kClear = 4.0 * kSearchTolerance;

// Whether a quad has only groups that are so.
template <class IsSo>
bool all_groups(const GroupQuad& groups, const IsSo& is_so) {
  for (std::size_t lane = 0; lane < kSiblings; ++lane) {
    if (!groups.is_free(lane) && !is_so(lane)) return false;
  }
  return true;
}
bool all_before(const GroupQuad& groups, const QuadSpan& in_box, double s) {
  return all_groups(groups, [&](std::size_t lane) { return in_box.hi[lane] < s - kClear; });
}
bool all_after(const GroupQuad& groups, const QuadSpan& in_box, double s) {
  return all_groups(groups, [&](std::size_t lane) { return in_box.lo[lane] > s + kClear; });
}

double depth_of(const SweptIntervalEnd& end, bool leaving) { return leaving ? end.s : -end.s; }

}  // namespace

SeparatingPlane EndPlanes::at(const SweptIntervalEnd& end, bool leaving) const {
  const auto& segment = question_.path->segments[end.segment];
  const ToolPose &from = question_.path->from(segment), &to = question_.path->to(segment);
  if (end.t == 0.0 || end.t == 1.0) {
    const ToolPose& pose = end.t == 0.0 ? from : to;
    return {body_, question_.ray, {end.s, end.section, end.face, pose}, leaving};
  }
  const SegmentMotion motion(from, to, body_.reach());
  return {body_, question_.ray, {end.s, end.section, end.face, motion.at(end.t)}, leaving};
}

WholeSweep::WholeSweep(const RayQuestion& question, const ToolSweep& sweep, const EndPlanes& planes,
                       std::span<const SweptInterval> swept)
    : question_(question), quads_(sweep.tree.quads()), planes_(planes) {
  for (const SweptInterval& c : swept) {
    pieces_.push_back({{.at = c.lo, .solved = true, .has_plane = true},
                       {.at = c.hi, .solved = true, .has_plane = true}});
  }
}

std::vector<SweptInterval> WholeSweep::swept() const {
  std::vector<SweptInterval> all;
  all.reserve(pieces_.size());
  for (const Piece& c : pieces_) all.push_back({c.lo.at, c.hi.at});
  return all;
}

std::optional<std::uint32_t> WholeSweep::unsolved() const {
  for (const Piece& c : pieces_) {
    if (!c.lo.solved && c.lo.at.s > span().lo && c.lo.at.s < span().hi) return c.lo.at.segment;
    if (!c.hi.solved && c.hi.at.s > span().lo && c.hi.at.s < span().hi) return c.hi.at.segment;
  }
  return std::nullopt;
}

std::optional<double> WholeSweep::end_at_pose_of(std::uint32_t segment) const {
  for (const Piece& c : pieces_) {
    for (const SweptIntervalEnd& end : {c.lo.at, c.hi.at}) {
      if (end.segment == segment && (end.t == 0.0 || end.t == 1.0)) return end.t;
    }
  }
  return std::nullopt;
}

void WholeSweep::settle(std::uint32_t segment) {
  for (Piece& c : pieces_) {
    for (End* end : {&c.lo, &c.hi}) end->solved = end->solved || end->at.segment == segment;
  }
}

// Whether nothing that begins with segment `earliest`, and reaches as deep as this, wins the end.
bool WholeSweep::behind(double depth, std::uint32_t earliest, const End& end, bool leaving) {
  const double here = depth_of(end.at, leaving);
  if (depth < here - 2.0 * kSearchTolerance) return true;
  const double mine = step_of(here), theirs = step_of(depth);
  if (theirs != mine) return theirs < mine;
  return earliest > end.at.segment || (end.solved && earliest == end.at.segment);
}

RaySpan WholeSweep::counted(const GroupReach& reach) {
  return {reach.lo - std::max(kBoundRounding, kRoundingShare * reach.lo_slack),
          reach.hi + std::max(kBoundRounding, kRoundingShare * reach.hi_slack)};
}

bool WholeSweep::wants(std::uint32_t group, const RaySpan& counted) const {
  const auto [lo, hi] = counted;
  if (!(std::max(lo, span().lo) <= std::min(hi, span().hi))) return false;
  const std::uint32_t earliest = quads_[group / kSiblings].earliest[group % kSiblings];
  for (const Piece& c : pieces_) {
    if (!(lo <= c.hi.at.s && hi >= c.lo.at.s)) continue;
    const bool held = (c.hi.at.s >= span().hi || behind(hi, earliest, c.hi, true)) &&
                      (c.lo.at.s <= span().lo || behind(-lo, earliest, c.lo, false));
    if (held) return false;
  }
  return true;
}

bool WholeSweep::wants_piece(std::uint32_t, double lo, double hi) const {
  lo = std::max(lo, span().lo);
  hi = std::min(hi, span().hi);
  return lo <= hi && std::ranges::none_of(pieces_, [&](const Piece& c) {
           return c.lo.at.s <= lo && hi <= c.hi.at.s;
         });
}

const SeparatingPlane& WholeSweep::plane_at(End& end, bool leaving) const {
  if (!end.has_plane) {
    end.plane = planes_.at(end.at, leaving);
    end.has_plane = true;
  }
  return end.plane;
}

WholeSweep::Held WholeSweep::held_by(End& end, const GroupQuad& groups, bool leaving) const {
  const Overreach over = plane_at(end, leaving).overreach(groups, 0.0);
  Held held;
  for (std::size_t lane = 0; lane < kSiblings; ++lane) {
    held.bounds[lane] = over.most[lane] < kInfinity;
    held.is_beyond[lane] = over.height[lane] < 0.0;
    held.holds[lane] = held.bounds[lane] && behind(depth_of(end.at, leaving) + over.most[lane] +
                                                       kBoundRounding + over.rounding[lane],
                                                   groups.earliest[lane], end, leaving);
  }
  return held;
}

bool WholeSweep::held_by(End& end, std::uint32_t segment, bool leaving) const {
  const auto& at = question_.path->segments[segment];
  const ToolPose &from = question_.path->from(at), &to = question_.path->to(at);
  if (end.solved && segment == end.at.segment) return true;
  constexpr double kRounding = kRoundingShare * kSearchTolerance;
  const SeparatingPlane& plane = plane_at(end, leaving);
  if (segment > end.at.segment) {
    const double depth = depth_of(end.at, leaving);
    if (step_of(depth + 2.0 * kRounding / kGrazingEnd) == step_of(depth) &&
        plane.along(from) > kGrazingEnd) {
      return plane.holds(from, to, kRounding);
    }
  }
  return plane.holds(from, to, kWellBefore);
}

QuadLimit WholeSweep::limit(const GroupQuad& groups, const QuadSpan& in_box) {
  QuadLimit limits{};
  for (Piece& c : pieces_) {
    // What is elsewhere on the ray may be held back as well, but rarely is.
    double first = kInfinity, last = -kInfinity;
    for (std::size_t lane = 0; lane < kSiblings; ++lane) {
      if (groups.is_free(lane)) continue;
      if (!(in_box.lo[lane] <= c.hi.at.s && in_box.hi[lane] >= c.lo.at.s)) continue;
      first = std::min(first, in_box.lo[lane]);
      last = std::max(last, in_box.hi[lane]);
    }
    if (!(first <= last)) continue;
    // What the nearer end does not hold back, the other mostly does.
    Held hi, lo;
    const auto ask_hi = [&] {
      if (c.hi.at.s < span().hi && !all_before(groups, in_box, c.hi.at.s))
        hi = held_by(c.hi, groups, true);
      return hi.any();
    };
    const auto ask_lo = [&] {
      if (c.lo.at.s > span().lo && !all_after(groups, in_box, c.lo.at.s))
        lo = held_by(c.lo, groups, false);
      return lo.any();
    };
    const bool is_near_hi = last - c.hi.at.s > c.lo.at.s - first;
    static_cast<void>(is_near_hi ? ask_hi() && ask_lo() : ask_lo() && ask_hi());
    bool all = true;
    for (std::size_t lane = 0; lane < kSiblings; ++lane) {
      GroupLimit& limit = limits[lane];
      limit.holds = limit.holds || (hi.holds[lane] && lo.holds[lane]);
      all = all && limit.holds;
      if (!hi.bounds[lane] || !lo.bounds[lane]) continue;
      // It is beside this piece: what its representative covers says little more.
      limit.hi = span().hi;
      limit.counts_representative = hi.is_beyond[lane] || lo.is_beyond[lane];
    }
    if (all) break;
  }
  return limits;
}

double WholeSweep::room(std::uint32_t segment, const ToolPose&, const ToolPose&) {
  const bool held = std::ranges::any_of(pieces_, [&](Piece& c) {
    return (c.hi.at.s >= span().hi || held_by(c.hi, segment, true)) &&
           (c.lo.at.s <= span().lo || held_by(c.lo, segment, false));
  });
  return held ? 0.0 : -1.0;
}

WholeSweep::HeldLanes WholeSweep::held_by(End& end, const LeafMotions& leaf, bool leaving) const {
  const DoubleFour rooms = plane_at(end, leaving).rooms(leaf.motions, kWellBefore);
  HeldLanes held{};
  for (std::size_t lane = 0; lane < leaf.count; ++lane) {
    const std::uint32_t segment = leaf.segments[lane];
    held[lane] = rooms[lane] >= 0.0 || (end.solved && segment == end.at.segment) ||
                 (segment > end.at.segment && held_by(end, segment, leaving));
  }
  return held;
}

DoubleFour WholeSweep::rooms(const LeafMotions& leaf, const RaySpan& counted) {
  DoubleFour rooms = four_of(-1.0);
  for (Piece& c : pieces_) {
    HeldLanes held{true, true, true, true};
    const bool asks_hi = c.hi.at.s < span().hi && counted.hi >= c.hi.at.s - kClear;
    const bool asks_lo = c.lo.at.s > span().lo && counted.lo <= c.lo.at.s + kClear;
    if (asks_hi) held = held_by(c.hi, leaf, true);
    if (std::ranges::none_of(held, std::identity())) continue;
    if (asks_lo) {
      const HeldLanes by_lo = held_by(c.lo, leaf, false);
      for (std::size_t lane = 0; lane < kSiblings; ++lane) held[lane] = held[lane] && by_lo[lane];
    }
    for (std::size_t lane = 0; lane < kSiblings; ++lane) {
      if (held[lane]) rooms[lane] = 0.0;
    }
  }
  return rooms;
}

std::span<const Chord> WholeSweep::known() {
  known_.clear();
  for (const Piece& c : pieces_) known_.push_back({c.lo.at.s, c.hi.at.s});
  return {known_.data(), known_.size()};
}

std::span<const Chord> WholeSweep::floors() {
  // Many times what a search tolerates (kSearchTolerance).
  constexpr double kWellInside = 1e-8;  // mm
  known_.clear();
  for (const Piece& c : pieces_) {
    const Chord inside{c.lo.at.s + kWellInside, c.hi.at.s - kWellInside};
    if (inside.lo < inside.hi) known_.push_back(inside);
  }
  return {known_.data(), known_.size()};
}

void WholeSweep::take(const SweptInterval& next) {
  SweptInterval less = next;
  less.lo.s += kPoseRounding;
  less.hi.s -= kPoseRounding;
  if (less.lo.s < less.hi.s) join(less, false);
}

bool WholeSweep::wins(const End& a, const End& b, bool leaving) {
  const double a_depth = depth_of(a.at, leaving), b_depth = depth_of(b.at, leaving);
  const double a_step = step_of(a_depth), b_step = step_of(b_depth);
  if (a_step != b_step) return a_step > b_step;
  if (a.at.segment != b.at.segment) return a.at.segment < b.at.segment;
  return a_depth != b_depth ? a_depth > b_depth : a.solved;
}

void WholeSweep::join(const SweptInterval& next, bool solved) {
  auto first = pieces_.begin();
  while (first != pieces_.end() && first->hi.at.s < next.lo.s - kTouching) ++first;
  Piece joined{{.at = next.lo, .solved = solved}, {.at = next.hi, .solved = solved}};
  auto last = first;
  bool lo_is_old = false, hi_is_old = false;
  for (; last != pieces_.end() && last->lo.at.s <= next.hi.s + kTouching; ++last) {
    if (!wins(joined.lo, last->lo, false)) {
      joined.lo = last->lo;
      lo_is_old = true;
    }
    if (!wins(joined.hi, last->hi, true)) {
      joined.hi = last->hi;
      hi_is_old = true;
    }
  }
  if (first == last) {
    pieces_.insert(first, joined);
    ++change_;
    return;
  }
  if (!lo_is_old || !hi_is_old || last - first > 1) ++change_;
  *first = joined;
  pieces_.erase(first + 1, last);
}

}  // namespace frustum::cutter
