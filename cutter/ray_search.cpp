#include "cutter/ray_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "cutter/carved_sweep.hpp"

namespace frustum::cutter {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Below this cosine between ray and surface the touching planes bound badly; the grown cutter helps.
constexpr double kGrazing = 0.02;
// And where the axes of a group differ by more than this (rad).
constexpr double kMuchTurned = 0.1;
// Parts of a cutter that stand on each other touch within this (mm): rounding of their ends.
constexpr double kTouching = 1e-11;

// Where along the ray a group may cover anything, and what its witness covers for certain.
struct Reach {
  double lo = kInfinity;
  double hi = -kInfinity;
  double lo_slack = 0.0;  // what the tolerance normal to the surface makes along the ray
  double hi_slack = 0.0;

  [[nodiscard]] bool empty() const { return !(lo <= hi); }
};

// Beyond what place along the ray no pose of the group reaches, by the plane that touches the witness.
//
// At another pose, tip p + dp and axis a + da, the plane through the contact y (from the tip) has the normal
// n + dn, dn = axial da - lateral (side.da) a within 2 |da|^2, and lies dn.y - n.dp - dn.dp nearer.
double crossing(const TouchingPlane& plane, const PoseGroup& group, const Ray& ray) {
  constexpr double kFarTurned = 0.5;  // the expansion holds below
  const double turned = group.axis_shift;
  if (turned == 0.0) return plane.value + farthest_tip(group, plane.normal) / plane.along;
  if (turned > kFarTurned) return kInfinity;
  const double fall = plane.along - turned * (1.0 + 2.0 * turned);
  if (!(fall > 0.0)) return kInfinity;
  const Vec3 y = ray.at(plane.direction * plane.value) - group.witness.tip;
  const Vec3 c = plane.lateral * y.dot(group.witness.axis) * plane.side - plane.axial * y;
  const double room = farthest_tip(group, plane.normal) + farthest_axis(group, c) +
                      turned * (1.0 + 2.0 * turned) * group.tip_shift +
                      2.0 * turned * turned * y.norm();
  return plane.value + std::max(0.0, room) / fall;
}

// What the tolerance normal to the plane makes along the ray, at any pose of the group.
double slack_of(const TouchingPlane& plane, const PoseGroup& group) {
  const double turned = group.axis_shift;
  return kSearchTolerance / (plane.along + turned * (1.0 + 2.0 * turned));
}

bool surely_apart(const PoseGroup& group, const Profile& part, const Ray& ray) {
  const Vec3 offset = ray.origin - group.witness.tip;
  const auto apart = [&](const Vec3& n) { return n.dot(offset) > support(group, part, n); };
  const Vec3 across = ray.direction.cross(group.witness.axis);
  const double sine = across.norm();
  if (sine > 1e-3) {
    const double side = across.dot(offset) > 0.0 ? 1.0 : -1.0;
    if (apart(across * (side / sine))) return true;
  }
  const Vec3 facing = group.witness.axis - ray.direction.dot(group.witness.axis) * ray.direction;
  const double length = facing.norm();
  if (length < 1e-3) return false;
  const double middle = 0.5 * (part.bottom() + part.height());
  const double side = facing.dot(offset) > middle * length * length ? 1.0 : -1.0;
  return apart(facing * (side / length));
}

// Bounds for what the group covers, from a chord of its witness or from the grown witness. `wants_lo` tells
// from the bound above and the witness's chord whether the bound below matters.
template <class WantsLo>
Reach reach_of(const PoseGroup& group, const Profile& part, const Ray& ray,
               const std::optional<Chord>& known, const WantsLo& wants_lo) {
  Reach reach;
  if (!known) {
    if (surely_apart(group, part, ray)) return reach;
    if (const auto grown = part.chord(group.witness, ray, group.shift)) {
      reach.lo = grown->lo;
      reach.hi = grown->hi;
    }
    return reach;
  }
  const TouchingPlane leaving(part, group.witness, ray, *known, true);
  reach.hi = crossing(leaving, group, ray);
  reach.hi_slack = slack_of(leaving, group);
  reach.lo = known->lo;
  double along = leaving.along;
  if (wants_lo(reach)) {
    const TouchingPlane entering(part, group.witness, ray, *known, false);
    reach.lo = -crossing(entering, group, ray);
    reach.lo_slack = slack_of(entering, group);
    along = std::min(along, entering.along);
  }
  if (along < kGrazing || group.axis_shift > kMuchTurned) {
    if (const auto grown = part.chord(group.witness, ray, group.shift)) {
      if (grown->lo > reach.lo) reach.lo_slack = 0.0;
      if (grown->hi < reach.hi) reach.hi_slack = 0.0;
      reach.lo = std::max(reach.lo, grown->lo);
      reach.hi = std::min(reach.hi, grown->hi);
    }
  }
  return reach;
}

// The search, for a goal that knows what it still wants:
//   bool wants(lo, hi, lo_slack, hi_slack)   could this still add anything?
//   bool puts_aside(group, lo)               not now, since it begins at lo
//   bool wants_lo(lo, hi)                    does it matter where it begins?
//   void take(interval)                      covered for certain
//   span<const Chord> known()                ends of stretches inside these need not be exact
template <class Goal>
class Search {
 public:
  Search(const RayQuestion& question, const ToolSweep& sweep, Goal& goal)
      : question_(question),
        sweep_(sweep),
        goal_(goal),
        parts_(sweep.body->parts()),
        groups_(sweep.tree.groups()),
        in_box_(question.ray) {}

  void run(std::uint32_t group) {
    if (groups_.empty()) return;
    const Judgement root = judge(group);
    if (root.wanted) visit(group);
  }

 private:
  struct Judgement {
    bool wanted = false;
    double lo = kInfinity;
    double hi = -kInfinity;
    double lo_slack = kInfinity;
    double hi_slack = kInfinity;
  };

  Judgement judge(std::uint32_t index) {
    const PoseGroup& group = groups_[index];
    Judgement judged;
    if (group.earliest >= question_.first_excluded) return judged;
    const RaySpan in_box = in_box_.within(group.box, goal_.span());
    if (!(in_box.lo <= in_box.hi)) return judged;
    if (goal_.puts_aside(index, in_box.lo)) return judged;
    const auto wants_lo = [&](const Reach& reach) { return goal_.wants_lo(reach.lo, reach.hi); };
    const bool counts = group.witness_stretch < question_.first_excluded;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const auto known = parts_[i].chord(group.witness, question_.ray);
      if (known && counts) {
        const auto part = static_cast<std::uint32_t>(i);
        goal_.take({{known->lo, group.witness_stretch, part, 0.0, known->lo_face},
                    {known->hi, group.witness_stretch, part, 0.0, known->hi_face}});
      }
      widen(judged, reach_of(group, parts_[i], question_.ray, known, wants_lo));
    }
    for (const Profile& hull : sweep_.body->carved()) {
      const auto known = hull.chord(group.witness, question_.ray);
      widen(judged, reach_of(group, hull, question_.ray, known, wants_lo));
    }
    judged.wanted = goal_.wants(index, judged.lo, judged.hi, judged.lo_slack, judged.hi_slack);
    return judged;
  }

  static void widen(Judgement& judged, const Reach& reach) {
    if (reach.empty()) return;
    judged.lo = std::min(judged.lo, reach.lo);
    judged.hi = std::max(judged.hi, reach.hi);
    judged.lo_slack = std::min(judged.lo_slack, reach.lo_slack);
    judged.hi_slack = std::min(judged.hi_slack, reach.hi_slack);
  }

  void visit(std::uint32_t index) {
    const PoseGroup& group = groups_[index];
    if (group.count > 0) {
      for (const std::uint32_t stretch :
           sweep_.tree.stretches().subspan(group.first, group.count)) {
        if (stretch < question_.first_excluded) solve(stretch);
      }
      return;
    }
    const std::array<std::uint32_t, 2> child{index + 1, group.second_child};
    const std::array<Judgement, 2> judged{judge(child[0]), judge(child[1])};
    // The one that may reach farther first: it is likely to make the other needless.
    const bool swap = judged[1].hi - judged[1].lo > judged[0].hi - judged[0].lo;
    for (const std::size_t k : {swap ? 1U : 0U, swap ? 0U : 1U}) {
      const Judgement& j = judged[k];
      if (j.wanted && goal_.wants(child[k], j.lo, j.hi, j.lo_slack, j.hi_slack)) visit(child[k]);
    }
  }

  void solve(std::uint32_t index) {
    const auto& stretch = question_.path->stretches[index];
    const StretchMotion motion(question_.path->from(stretch), question_.path->to(stretch),
                               sweep_.body->reach());
    for (std::size_t i = 0; i <= parts_.size(); ++i) {
      found_.clear();
      if (i < parts_.size()) {
        append_swept_intervals(parts_[i], motion, question_.ray, goal_.known(), found_);
      } else if (!sweep_.body->carved().empty()) {
        append_carved_intervals(*sweep_.body, motion, question_.ray, goal_.known(), found_);
      }
      const auto part = static_cast<std::uint32_t>(i);
      for (const SweptInterval& f : found_) {
        goal_.take(
            {{f.lo.s, index, part, f.lo.t, f.lo.face}, {f.hi.s, index, part, f.hi.t, f.hi.face}});
      }
    }
  }

  const RayQuestion& question_;
  const ToolSweep& sweep_;
  Goal& goal_;
  std::span<const Profile> parts_;
  std::span<const PoseGroup> groups_;
  BoxCrossing in_box_;
  std::vector<SweptInterval> found_{};
};

// Everything within the span.
class WholeCover {
 public:
  WholeCover(const RaySpan& span, std::vector<CoverInterval>& cover) : span_(span), cover_(cover) {}

  [[nodiscard]] const RaySpan& span() const { return span_; }
  [[nodiscard]] static bool puts_aside(std::uint32_t, double) { return false; }
  [[nodiscard]] static bool wants_lo(double, double) { return true; }

  [[nodiscard]] bool wants(std::uint32_t, double lo, double hi, double lo_slack,
                           double hi_slack) const {
    lo = std::max(lo, span_.lo);
    hi = std::min(hi, span_.hi);
    if (!(lo <= hi)) return false;
    for (const CoverInterval& c : cover_) {
      if (c.lo.s <= lo + lo_slack && hi - hi_slack <= c.hi.s) return false;
    }
    return true;
  }

  [[nodiscard]] std::span<const Chord> known() {
    known_.clear();
    for (const CoverInterval& c : cover_) known_.push_back({c.lo.s, c.hi.s});
    return known_;
  }

  void take(const CoverInterval& next) {
    // The intervals that touch it become one with it; a tie keeps the older end.
    auto first = cover_.begin();
    while (first != cover_.end() && first->hi.s < next.lo.s - kTouching) ++first;
    auto last = first;
    CoverInterval joined = next;
    while (last != cover_.end() && last->lo.s <= next.hi.s + kTouching) {
      if (last->lo.s <= joined.lo.s) joined.lo = last->lo;
      if (last->hi.s >= joined.hi.s) joined.hi = last->hi;
      ++last;
    }
    if (first == last) {
      cover_.insert(first, joined);
      return;
    }
    *first = joined;
    cover_.erase(first + 1, last);
  }

 private:
  RaySpan span_;
  std::vector<CoverInterval>& cover_;
  std::vector<Chord> known_{};
};

// Only what continues the cover from where the front stands.
class Front {
 public:
  Front(const RaySpan& span, double gap, CoverEnd& front) : span_(span), gap_(gap), front_(front) {}

  [[nodiscard]] RaySpan span() const { return {front_.s - gap_, span_.hi}; }

  // What begins beyond the front is asked again when the front has come there.
  [[nodiscard]] bool puts_aside(std::uint32_t group, double lo) {
    if (lo <= front_.s + gap_) return false;
    deferred_.push_back({lo, group});
    return true;
  }

  [[nodiscard]] bool wants_lo(double lo, double hi) const {
    return hi > front_.s && lo > front_.s + gap_;
  }

  [[nodiscard]] bool wants(std::uint32_t group, double lo, double hi, double, double hi_slack) {
    if (!(lo <= hi) || hi <= front_.s + hi_slack) return false;
    return !puts_aside(group, lo);
  }

  [[nodiscard]] std::span<const Chord> known() {
    known_ = {-kInfinity, front_.s};
    return {&known_, 1};
  }

  void take(const CoverInterval& next) {
    if (next.lo.s > front_.s + gap_ || next.hi.s <= front_.s) return;
    front_ = next.hi;
    moved_ = true;
  }

  // A group that the front has come up to since it was put aside.
  [[nodiscard]] std::optional<std::uint32_t> next_deferred() {
    for (std::size_t i = 0; i < deferred_.size(); ++i) {
      if (deferred_[i].lo > front_.s + gap_) continue;
      const std::uint32_t group = deferred_[i].group;
      deferred_.erase(deferred_.begin() + static_cast<std::ptrdiff_t>(i));
      return group;
    }
    return std::nullopt;
  }

  [[nodiscard]] bool moved() const { return moved_; }

 private:
  struct Deferred {
    double lo;
    std::uint32_t group;
  };
  RaySpan span_;
  double gap_;
  CoverEnd& front_;
  std::vector<Deferred> deferred_{};
  Chord known_{};
  bool moved_ = false;
};

}  // namespace

void extend_cover(const RayQuestion& question, const ToolSweep& sweep,
                  std::vector<CoverInterval>& cover) {
  WholeCover goal(question.span, cover);
  Search(question, sweep, goal).run(0);
}

bool advance_front(const RayQuestion& question, const ToolSweep& sweep, double gap,
                   CoverEnd& front) {
  Front goal(question.span, gap, front);
  Search search(question, sweep, goal);
  search.run(0);
  while (const auto group = goal.next_deferred()) search.run(*group);
  return goal.moved();
}

}  // namespace frustum::cutter
