#include "cutter/ray_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace frustum::cutter {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Below this cosine between ray and surface the touching planes bound badly; the grown cutter helps.
constexpr double kGrazing = 0.02;

// Where along the ray a group may cover anything, and what its witness covers for certain.
struct Reach {
  double lo = kInfinity;
  double hi = -kInfinity;
  double lo_slack = 0.0;  // what the tolerance normal to the surface makes along the ray
  double hi_slack = 0.0;
  std::optional<Chord> known{};

  [[nodiscard]] bool empty() const { return !(lo <= hi); }
};

// Where the plane that touches the witness, moved out by what the group needs, crosses the ray.
double crossing(const TouchingPlane& plane, const PoseGroup& group, const Profile& part,
                const Ray& ray) {
  return (support(group, part, plane.normal) - plane.normal.dot(ray.origin - group.witness.tip)) /
         plane.along;
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

Reach reach_of(const PoseGroup& group, const Profile& part, const Ray& ray) {
  Reach reach;
  reach.known = part.chord(group.witness, ray);
  if (!reach.known) {
    if (surely_apart(group, part, ray)) return reach;
    if (const auto grown = part.chord(group.witness, ray, group.shift)) {
      reach.lo = grown->lo;
      reach.hi = grown->hi;
    }
    return reach;
  }
  const TouchingPlane leaving(part, group.witness, ray, *reach.known, true);
  const TouchingPlane entering(part, group.witness, ray, *reach.known, false);
  reach.hi = crossing(leaving, group, part, ray);
  reach.lo = -crossing(entering, group, part, ray);
  if (std::min(leaving.along, entering.along) < kGrazing) {
    if (const auto grown = part.chord(group.witness, ray, group.shift)) {
      reach.lo = std::max(reach.lo, grown->lo);
      reach.hi = std::min(reach.hi, grown->hi);
    }
  }
  reach.lo_slack = kSearchTolerance / entering.along;
  reach.hi_slack = kSearchTolerance / leaving.along;
  return reach;
}

class Slabs {
 public:
  explicit Slabs(const Ray& ray) : origin_(ray.origin) {
    for (int k = 0; k < 3; ++k) inverse_[k] = 1.0 / ray.direction[k];
  }
  // True if the ray may cross the box within the span.
  [[nodiscard]] bool cross(const Box& box, const RaySpan& span) const {
    double lo = span.lo, hi = span.hi;
    for (int k = 0; k < 3; ++k) {
      if (std::isinf(inverse_[k])) {
        if (origin_[k] < box.min[k] - kMargin || origin_[k] > box.max[k] + kMargin) return false;
        continue;
      }
      const double a = (box.min[k] - kMargin - origin_[k]) * inverse_[k];
      const double b = (box.max[k] + kMargin - origin_[k]) * inverse_[k];
      lo = std::max(lo, std::min(a, b));
      hi = std::min(hi, std::max(a, b));
    }
    return lo <= hi;
  }

 private:
  static constexpr double kMargin = 1e-9;  // mm, above rounding
  Vec3 origin_;
  Vec3 inverse_ = Vec3::Zero();
};

// The search, for a goal that knows what it still wants:
//   bool wants(lo, hi, lo_slack, hi_slack)   could this still add anything?
//   void take(interval)                      covered for certain
//   span<const Chord> known()                ends of stretches inside these need not be exact
template <class Goal>
class Search {
 public:
  Search(const RayQuestion& question, const ToolSweep& sweep, Goal& goal)
      : question_(question),
        sweep_(sweep),
        goal_(goal),
        groups_(sweep.tree.groups()),
        slabs_(question.ray) {}

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
    if (!slabs_.cross(group.box, goal_.span())) return judged;
    const auto parts = sweep_.parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Reach reach = reach_of(group, parts[i], question_.ray);
      if (reach.empty()) continue;
      if (reach.known && group.witness_stretch < question_.first_excluded) {
        const auto part = static_cast<std::uint32_t>(i);
        const Chord& k = *reach.known;
        goal_.take({{k.lo, group.witness_stretch, part, 0.0, k.lo_face},
                    {k.hi, group.witness_stretch, part, 0.0, k.hi_face}});
      }
      widen(judged, reach);
    }
    for (const Profile& hull : sweep_.carved) {
      const Reach reach = reach_of(group, hull, question_.ray);
      if (!reach.empty()) widen(judged, reach);
    }
    judged.wanted = goal_.wants(index, judged.lo, judged.hi, judged.lo_slack, judged.hi_slack);
    return judged;
  }

  static void widen(Judgement& judged, const Reach& reach) {
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
                               sweep_.reach);
    const auto parts = sweep_.parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      found_.clear();
      append_swept_intervals(parts[i], motion, question_.ray, goal_.known(), found_);
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
  std::span<const PoseGroup> groups_;
  Slabs slabs_;
  std::vector<SweptInterval> found_{};
};

// Everything within the span.
class WholeCover {
 public:
  WholeCover(const RaySpan& span, std::vector<CoverInterval>& cover) : span_(span), cover_(cover) {}

  [[nodiscard]] const RaySpan& span() const { return span_; }

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
    while (first != cover_.end() && first->hi.s < next.lo.s) ++first;
    auto last = first;
    CoverInterval joined = next;
    while (last != cover_.end() && last->lo.s <= next.hi.s) {
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

  [[nodiscard]] bool wants(std::uint32_t group, double lo, double hi, double, double hi_slack) {
    if (!(lo <= hi) || hi <= front_.s + hi_slack) return false;
    if (lo <= front_.s + gap_) return true;
    deferred_.push_back({lo, group});
    return false;
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
