#include "cutter/search/ray_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/constants.hpp"
#include "cutter/search/group_reach.hpp"
#include "cutter/search/separating_plane.hpp"
#include "cutter/sweep/concave_sweep.hpp"

namespace frustum::cutter {
namespace {

// Parts of a cutter that stand on each other touch within this (mm): rounding of their ends.
constexpr double kTouching = 1e-11;

// What the ends of the cover leave of a group: nothing, nothing of its representative, nothing beyond a place.
struct Limit {
  bool holds = false;
  bool counts_representative = true;
  double hi = kInfinity;
};

// The planes at the ends that a tool's own sweep has made so far.
class Guards {
 public:
  Guards(const RayQuestion& question, const Body& body) : question_(question), body_(body) {}

  [[nodiscard]] SeparatingPlane at(const SweptIntervalEnd& end, bool leaving) const {
    const auto& segment = question_.path->segments[end.segment];
    const SegmentMotion motion(*question_.path, segment, body_.reach());
    return {body_, question_.ray, {end.s, end.slab, end.face, motion.at(end.t)}, leaving};
  }

 private:
  const RayQuestion& question_;
  const Body& body_;
};

// Rays that graze make many pieces of one.
void join_overlapping(std::vector<SegmentInterval>& pieces) {
  std::ranges::sort(pieces, {}, [](const SegmentInterval& p) { return p.lo.s; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    if (pieces[i].lo.s > pieces[last].hi.s) {
      pieces[++last] = pieces[i];
    } else if (pieces[i].hi.s > pieces[last].hi.s) {
      pieces[last].hi = pieces[i].hi;
    }
  }
  if (!pieces.empty()) pieces.resize(last + 1);
}

// The search: what promises most comes first. Its goal knows what it still wants:
//   RaySpan span()            where on the ray
//   Limit limit(group)        what do the ends of the cover, by their planes, leave of the group?
//   bool holds(motion)        do they leave nothing of this motion?
//   bool wants(group, reach)  could this still add anything?
//   bool wants_lo(lo)         does it matter where a group begins whose representative begins there?
//   double promise(reach)     the more, the sooner it is asked
//   void take(interval)       covered for certain
//   span<const Chord> known() ends of segments inside these need not be exact
//   int change()              another number whenever the cover has grown
template <class Goal>
class Search {
 public:
  Search(const RayQuestion& question, const ToolSweep& sweep, Goal& goal)
      : question_(question),
        sweep_(sweep),
        goal_(goal),
        parts_(sweep.body->parts()),
        groups_(sweep.tree.groups()),
        in_box_(question.ray) {
    open_.reserve(64);
  }

  void run(std::uint32_t group) {
    if (groups_.empty()) return;
    consider(group);
    while (!open_.empty()) {
      std::ranges::pop_heap(open_, {}, &Candidate::promise);
      const Candidate next = open_.back();
      open_.pop_back();
      if (still_wanted(next)) visit(next.group);
    }
    while (!gaps_.empty()) {
      const Gap gap = gaps_.back();
      gaps_.pop_back();
      if (goal_.wants(gap.group, {gap.lo.s, gap.hi.s})) walk(gap);
    }
  }

 private:
  struct Candidate {
    std::uint32_t group = 0;
    int change = 0;  // of the cover, when it was judged
    GroupReach reach{};
    double promise = 0.0;
  };
  // Between an end of what a concave slab's hull sweeps, or of what was known then, and the next: what of it the
  // body covers is asked last, when least is left of it. `is_end`: of the body's own sweep.
  struct Gap {
    std::uint32_t group = 0, segment = 0;
    SweptIntervalEnd lo{}, hi{};
    bool lo_is_end = false, hi_is_end = false;
  };

  void consider(std::uint32_t index) {
    const PoseGroup& group = groups_[index];
    if (group.earliest >= question_.first_excluded) return;
    const RaySpan in_box = in_box_.within(group.box, goal_.span());
    if (!(in_box.lo <= in_box.hi)) return;
    GroupReach reach{in_box.lo, in_box.hi};
    if (!goal_.wants(index, reach)) return;
    const Limit limit = goal_.limit(group);
    if (limit.holds) return;
    // Else so far apart that one pose says nothing about the others.
    if (limit.counts_representative && group.shift <= sweep_.body->reach()) {
      reach = reach_by_representative(group, limit.hi == kInfinity);
    }
    if (limit.hi < reach.hi) {
      reach.hi = limit.hi;
      reach.hi_slack = 0.0;  // it is in the limit already
    }
    if (!goal_.wants(index, reach)) return;
    open_.push_back({index, goal_.change(), reach, goal_.promise(reach)});
    std::ranges::push_heap(open_, {}, &Candidate::promise);
  }

  // Since it was judged the cover may have grown.
  bool still_wanted(const Candidate& next) {
    if (goal_.change() == next.change) return true;
    return goal_.wants(next.group, next.reach) && !goal_.limit(groups_[next.group]).holds;
  }

  GroupReach reach_by_representative(const PoseGroup& group, bool wants_hi) {
    GroupReach reach = kNoReach;
    const auto widen = [&](const Profile& part, const std::optional<Chord>& known) {
      const GroupReach more = reach_of(group, part, question_.ray, known,
                                       {known && goal_.wants_lo(known->lo), wants_hi});
      reach.lo = std::min(reach.lo, more.lo);
      reach.hi = std::max(reach.hi, more.hi);
      reach.lo_slack = std::min(reach.lo_slack, more.lo_slack);
      reach.hi_slack = std::min(reach.hi_slack, more.hi_slack);
    };
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      const auto known = parts_[i].chord(group.representative, question_.ray);
      if (known && group.representative_segment < question_.first_excluded) {
        goal_.take({{known->lo, group.representative_segment, i, 0.0, known->lo_face},
                    {known->hi, group.representative_segment, i, 0.0, known->hi_face}});
      }
      widen(parts_[i], known);
    }
    for (const Profile& hull : sweep_.body->concave()) {
      widen(hull, hull.chord(group.representative, question_.ray));
    }
    return reach;
  }

  // Large trees do not fit into the caches: both of a pair are asked for before the first is looked at.
  void fetch(std::uint32_t pair) const {
    const auto* bytes = reinterpret_cast<const char*>(&groups_[pair]);
    constexpr std::size_t kLine = 64;
    for (std::size_t k = 0; k < 2 * sizeof(PoseGroup); k += kLine) __builtin_prefetch(bytes + k);
  }

  void visit(std::uint32_t index) {
    const PoseGroup& group = groups_[index];
    if (group.count == 0) {
      fetch(group.children);
      consider(group.children);
      consider(group.children + 1);
      return;
    }
    for (const std::uint32_t segment : sweep_.tree.segments().subspan(group.first, group.count)) {
      if (segment < question_.first_excluded) solve(index, segment);
    }
  }

  [[nodiscard]] SegmentMotion motion_of(std::uint32_t segment) const {
    return {*question_.path, question_.path->segments[segment], sweep_.body->reach()};
  }

  void solve(std::uint32_t group, std::uint32_t segment) {
    const SegmentMotion motion = motion_of(segment);
    if (goal_.holds(motion)) return;
    const auto slabs = sweep_.body->slabs();
    for (std::uint32_t i = 0; i < slabs.size(); ++i) {
      found_.clear();
      append_swept_intervals(slabs[i], motion, question_.ray, goal_.known(), found_);
      if (i >= parts_.size()) join_overlapping(found_);
      for (const SegmentInterval& f : found_) {
        const SweptInterval swept{{f.lo.s, segment, i, f.lo.t, f.lo.face},
                                  {f.hi.s, segment, i, f.hi.t, f.hi.face}};
        if (i < parts_.size()) {
          goal_.take(swept);
        } else {
          take_of_hull(group, motion, swept);
        }
      }
    }
  }

  // Between what is known of a hull's sweep: covered if the body, where it touches an end, stands there.
  void take_of_hull(std::uint32_t group, const SegmentMotion& motion, const SweptInterval& swept) {
    const ConcaveSweep concave(*sweep_.body, motion, question_.ray);
    covered_.clear();
    for_each_unknown(swept.lo.s, swept.hi.s, [&](double lo, double hi) {
      Gap gap{group, swept.lo.segment, swept.lo, swept.hi};
      gap.lo.s = lo;
      gap.hi.s = hi;
      gap.lo_is_end = lo == swept.lo.s && concave.is_of_body(swept_end(swept.lo));
      gap.hi_is_end = hi == swept.hi.s && concave.is_of_body(swept_end(swept.hi));
      const bool covered = (gap.hi_is_end && concave.stands_from(lo, swept_end(swept.hi))) ||
                           (gap.lo_is_end && concave.stands_from(hi, swept_end(swept.lo)));
      (covered ? covered_ : gaps_).push_back(gap);
    });
    for (const Gap& c : covered_) goal_.take({c.lo, c.hi});
  }

  // What of lo to hi is not known to be covered, in order. `then` must not take anything.
  template <class Then>
  void for_each_unknown(double lo, double hi, const Then& then) {
    for (const Chord& k : goal_.known()) {
      if (k.hi <= lo) continue;
      if (k.lo >= hi) break;
      if (k.lo > lo) then(lo, k.lo);
      lo = k.hi;
    }
    if (lo < hi) then(lo, hi);
  }

  [[nodiscard]] static SweptEnd swept_end(const SweptIntervalEnd& end) {
    return {end.s, end.t, end.face};
  }

  void walk(const Gap& gap) {
    const SegmentMotion motion = motion_of(gap.segment);
    if (goal_.holds(motion)) return;
    const ConcaveSweep concave(*sweep_.body, motion, question_.ray);
    const auto end_at = [&](const SweptEnd& end) -> SweptIntervalEnd {
      constexpr double kSameEnd = 1e-9;  // mm
      if (gap.lo_is_end && end.s - gap.lo.s < kSameEnd) return gap.lo;
      if (gap.hi_is_end && gap.hi.s - end.s < kSameEnd) return gap.hi;
      return {end.s, gap.segment, kInAHollow, end.t, end.face};
    };
    found_.clear();
    for_each_unknown(gap.lo.s, gap.hi.s,
                     [&](double lo, double hi) { concave.walk(lo, hi, found_); });
    for (const SegmentInterval& f : found_) goal_.take({end_at(f.lo), end_at(f.hi)});
  }

  const RayQuestion& question_;
  const ToolSweep& sweep_;
  Goal& goal_;
  std::span<const Profile> parts_;
  std::span<const PoseGroup> groups_;
  BoxCrossing in_box_;
  std::vector<Candidate> open_{};  // a heap by promise
  std::vector<SegmentInterval> found_{};
  std::vector<Gap> gaps_{}, covered_{};
};

// Everything within the span.
class WholeSweptInterval {
 public:
  // `cover` is what other tools cover: their ends have no guards here.
  WholeSweptInterval(const RaySpan& span, const Guards& guards,
                     std::span<const SweptInterval> cover)
      : span_(span), guards_(guards) {
    for (const SweptInterval& c : cover)
      cover_.push_back({c, SeparatingPlane(), SeparatingPlane()});
  }

  [[nodiscard]] std::vector<SweptInterval> cover() const {
    std::vector<SweptInterval> cover;
    for (const Guarded& c : cover_) cover.push_back(c.interval);
    return cover;
  }

  [[nodiscard]] const RaySpan& span() const { return span_; }
  [[nodiscard]] static bool wants_lo(double) { return true; }
  [[nodiscard]] static double promise(const GroupReach& reach) { return reach.hi - reach.lo; }
  [[nodiscard]] int change() const { return change_; }

  [[nodiscard]] bool wants(std::uint32_t, const GroupReach& reach) const {
    const double lo = std::max(reach.lo, span_.lo);
    const double hi = std::min(reach.hi, span_.hi);
    if (!(lo <= hi)) return false;
    return std::ranges::none_of(cover_, [&](const Guarded& c) {
      return c.interval.lo.s <= lo + reach.lo_slack && hi - reach.hi_slack <= c.interval.hi.s;
    });
  }

  [[nodiscard]] Limit limit(const PoseGroup& group) {
    return {.holds = between(
                [&](const SeparatingPlane& end) { return end.overreach(group).most <= 0.0; })};
  }
  [[nodiscard]] bool holds(const SegmentMotion& motion) {
    return between([&](const SeparatingPlane& end) { return end.holds(motion); });
  }

  [[nodiscard]] std::span<const Chord> known() {
    known_.clear();
    for (const Guarded& c : cover_) known_.push_back({c.interval.lo.s, c.interval.hi.s});
    return known_;
  }

  void take(const SweptInterval& next) {
    // The intervals that touch it become one with it; a tie keeps the older end.
    ++change_;
    auto first = cover_.begin();
    while (first != cover_.end() && first->interval.hi.s < next.lo.s - kTouching) ++first;
    auto last = first;
    Guarded joined{next, std::nullopt, std::nullopt};
    for (; last != cover_.end() && last->interval.lo.s <= next.hi.s + kTouching; ++last) {
      if (last->interval.lo.s <= joined.interval.lo.s) {
        joined.interval.lo = last->interval.lo;
        joined.lo = last->lo;
      }
      if (last->interval.hi.s >= joined.interval.hi.s) {
        joined.interval.hi = last->interval.hi;
        joined.hi = last->hi;
      }
    }
    if (first == last) {
      cover_.insert(first, joined);
      return;
    }
    *first = joined;
    cover_.erase(first + 1, last);
  }

 private:
  struct Guarded {
    SweptInterval interval{};
    std::optional<SeparatingPlane> lo{}, hi{};  // made when first asked for
  };
  // Whether it lies between the ends of one interval, both of which hold it back.
  template <class HeldBy>
  [[nodiscard]] bool between(const HeldBy& held_by) {
    return std::ranges::any_of(cover_, [&](Guarded& c) {
      if (c.interval.hi.s < span_.hi) {
        if (!c.hi) c.hi = guards_.at(c.interval.hi, true);
        if (!held_by(*c.hi)) return false;
      }
      if (c.interval.lo.s <= span_.lo) return true;
      if (!c.lo) c.lo = guards_.at(c.interval.lo, false);
      return held_by(*c.lo);
    });
  }

  RaySpan span_;
  const Guards& guards_;
  std::vector<Guarded> cover_{};
  std::vector<Chord> known_{};
  int change_ = 0;
};

// Only what continues the cover from where the front stands.
class Front {
 public:
  Front(const RaySpan& span, const Guards& guards, double gap, SweptIntervalEnd& front)
      : span_(span), guards_(guards), gap_(gap), front_(front) {}

  [[nodiscard]] RaySpan span() const { return {front_.s - gap_, span_.hi}; }

  [[nodiscard]] bool wants_lo(double lo) const { return lo > front_.s + gap_; }
  [[nodiscard]] static double promise(const GroupReach& reach) { return reach.hi; }
  [[nodiscard]] int change() const { return change_; }

  // What begins beyond the front is asked again when the front has come there.
  [[nodiscard]] bool wants(std::uint32_t group, const GroupReach& reach) {
    if (!(reach.lo <= reach.hi) || reach.hi <= front_.s + reach.hi_slack) return false;
    if (reach.lo <= front_.s + gap_) return true;
    deferred_.push_back({reach.lo, group});
    return false;
  }

  // Whatever a group covers before the front does not matter.
  [[nodiscard]] Limit limit(const PoseGroup& group) {
    if (change_ == 0) return {};
    const Overreach over = guard().overreach(group);
    return {over.most <= 0.0, over.by_representative, front_.s + over.most};
  }
  [[nodiscard]] bool holds(const SegmentMotion& motion) {
    return change_ > 0 && guard().holds(motion);
  }

  [[nodiscard]] std::span<const Chord> known() {
    known_ = {-kInfinity, front_.s};
    return {&known_, 1};
  }

  // What begins beyond the front counts when the front has come there.
  void take(const SweptInterval& next) {
    if (next.hi.s <= front_.s) return;
    if (next.lo.s > front_.s + gap_) {
      ahead_.push_back(next);
      return;
    }
    move_to(next.hi);
    for (std::size_t i = 0; i < ahead_.size();) {
      if (ahead_[i].lo.s > front_.s + gap_) {
        ++i;
        continue;
      }
      const SweptIntervalEnd end = ahead_[i].hi;
      ahead_[i] = ahead_.back();
      ahead_.pop_back();
      if (end.s > front_.s) {
        move_to(end);
        i = 0;
      }
    }
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

  [[nodiscard]] bool moved() const { return change_ > 0; }

 private:
  [[nodiscard]] const SeparatingPlane& guard() {
    if (!guard_) guard_ = guards_.at(front_, true);
    return *guard_;
  }

  void move_to(const SweptIntervalEnd& end) {
    front_ = end;
    guard_.reset();
    ++change_;
  }

  struct Deferred {
    double lo;
    std::uint32_t group;
  };
  RaySpan span_;
  const Guards& guards_;
  double gap_;
  SweptIntervalEnd& front_;
  std::optional<SeparatingPlane> guard_{};  // at the front; made when first asked for
  std::vector<Deferred> deferred_{};
  std::vector<SweptInterval> ahead_{};
  Chord known_{};
  int change_ = 0;
};

}  // namespace

void extend_swept_interval(const RayQuestion& question, const ToolSweep& sweep,
                           std::vector<SweptInterval>& cover) {
  const Guards guards(question, *sweep.body);
  WholeSweptInterval goal(question.span, guards, cover);
  Search(question, sweep, goal).run(0);
  cover = goal.cover();
}

bool advance_front(const RayQuestion& question, const ToolSweep& sweep, double gap,
                   SweptIntervalEnd& front) {
  const Guards guards(question, *sweep.body);
  Front goal(question.span, guards, gap, front);
  Search search(question, sweep, goal);
  search.run(0);
  while (const auto group = goal.next_deferred()) search.run(*group);
  return goal.moved();
}

}  // namespace frustum::cutter
