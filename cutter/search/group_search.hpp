// The search of a tool's tree of poses for what it covers of a ray, whatever is wanted of that.
//
// Model    : groups that the goal does not want any more are left aside; of the others the
//            representative adds what it covers, and the halves are asked, what promises most
//            first, down to the path segments themselves. What a concave body covers beside its
//            convex parts is asked last
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : as ray_search.hpp
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/box.hpp"
#include "core/constants.hpp"
#include "cutter/search/group_reach.hpp"
#include "cutter/search/ray_search.hpp"
#include "cutter/sweep/concave_sweep.hpp"

namespace frustum::cutter {

// What the ends found so far leave of a group: nothing, nothing of its representative, nothing
// beyond a place.
struct GroupLimit {
  bool holds = false;
  bool counts_representative = true;
  double hi = kInfinity;
};

// What promises most comes first. The goal knows what it still wants:
//   RaySpan span()            where on the ray
//   GroupLimit limit(group)   what do the ends found so far, by their planes, leave of the group?
//   bool holds(segment, motion)  do they leave nothing of this motion?
//   bool wants(group, reach)  could this still add anything?
//   bool wants_lo(lo)         does it matter where a group begins whose representative begins
//   there? double promise(reach)     the more, the sooner it is asked
//   void take(interval)       covered for certain
//   void take_solved(interval)  what a segment covers: its own ends
//   span<const Chord> known() is covered anyway
//   span<const Chord> floors() ends of segments inside these need not be exact
//   bool wants_piece(group, lo, hi)  could a piece of ray still add anything?
//   int change()              another number whenever more is covered
template <class Goal>
class GroupSearch {
 public:
  GroupSearch(const RayQuestion& question, const ToolSweep& sweep, Goal& goal)
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
    run(std::span(&group, 1));
  }
  // In the order given, but that what promises most comes first.
  void run(std::span<const std::uint32_t> groups) {
    for (const std::uint32_t group : groups) consider(group);
    while (!open_.empty()) {
      std::ranges::pop_heap(open_, {}, &Candidate::promise);
      const Candidate next = open_.back();
      open_.pop_back();
      if (still_wanted(next)) visit(next.group);
    }
    while (!gaps_.empty()) {
      const Gap gap = gaps_.back();
      gaps_.pop_back();
      if (goal_.wants_piece(gap.group, gap.lo.s, gap.hi.s)) walk(gap);
    }
  }

  // What the convex parts cover in this segment, whatever is covered already.
  void solve_parts(std::uint32_t segment) { solve_parts(segment, motion_of(segment)); }

 private:
  struct Candidate {
    std::uint32_t group = 0;
    int change = 0;  // of the goal, when it was judged
    GroupReach reach{};
    double promise = 0.0;
  };
  // Between an end of what a concave section's hull sweeps, or of what was known then, and the
  // next: what of it the body covers is asked last, when least is left of it. `is_end`: of the
  // body's own sweep.
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
    const GroupLimit limit = goal_.limit(group);
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

  // Since it was judged more may be covered.
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

  // Large trees do not fit into the caches: both of a pair are asked for before the first is looked
  // at.
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
    if (is_away(group, motion) || goal_.holds(segment, motion)) return;
    solve_parts(segment, motion);
    const auto sections = sweep_.body->sections();
    for (auto i = static_cast<std::uint32_t>(parts_.size()); i < sections.size(); ++i) {
      found_.clear();
      append_swept_intervals(sections[i], motion, question_.ray, goal_.known(), found_);
      join_overlapping(found_);
      for (const SegmentInterval& f : found_) take_of_hull(group, motion, swept_of(segment, i, f));
    }
  }

  // Whether the cutter where the motion begins, grown by all of its way, covers nothing wanted.
  [[nodiscard]] bool is_away(std::uint32_t group, const SegmentMotion& motion) {
    constexpr double kRounding = 1e-9;  // mm
    GroupReach reach = kNoReach;
    for (const Profile& section : sweep_.body->sections()) {
      const auto grown = section.chord(motion.at(0.0), question_.ray, motion.travel() + kRounding);
      if (!grown) continue;
      reach.lo = std::min(reach.lo, grown->lo);
      reach.hi = std::max(reach.hi, grown->hi);
    }
    reach.lo_slack = reach.hi_slack = 0.0;
    return !(reach.lo <= reach.hi) || !goal_.wants(group, reach);
  }

  void solve_parts(std::uint32_t segment, const SegmentMotion& motion) {
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      found_.clear();
      append_swept_intervals(parts_[i], motion, question_.ray, goal_.floors(), found_);
      for (const SegmentInterval& f : found_) goal_.take_solved(swept_of(segment, i, f));
    }
  }

  [[nodiscard]] static SweptInterval swept_of(std::uint32_t segment, std::uint32_t section,
                                              const SegmentInterval& f) {
    return {{f.lo.s, segment, section, f.lo.t, f.lo.face},
            {f.hi.s, segment, section, f.hi.t, f.hi.face}};
  }

  // Between what is known of a hull's sweep: covered if the body is there
  // where it touches an end.
  void take_of_hull(std::uint32_t group, const SegmentMotion& motion, const SweptInterval& swept) {
    const ConcaveSweep concave(*sweep_.body, motion, question_.ray);
    covered_.clear();
    for_each_unknown(swept.lo.s, swept.hi.s, [&](double lo, double hi) {
      Gap gap{group, swept.lo.segment, swept.lo, swept.hi};
      gap.lo.s = lo;
      gap.hi.s = hi;
      gap.lo_is_end = lo == swept.lo.s && concave.is_of_body(swept_end(swept.lo));
      gap.hi_is_end = hi == swept.hi.s && concave.is_of_body(swept_end(swept.hi));
      const bool covered = (gap.hi_is_end && concave.covers_from(lo, swept_end(swept.hi))) ||
                           (gap.lo_is_end && concave.covers_from(hi, swept_end(swept.lo)));
      (covered ? covered_ : gaps_).push_back(gap);
    });
    for (const Gap& c : covered_) goal_.take_solved({c.lo, c.hi});
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
    if (goal_.holds(gap.segment, motion)) return;
    const ConcaveSweep concave(*sweep_.body, motion, question_.ray);
    const auto end_at = [&](const SweptEnd& end) -> SweptIntervalEnd {
      constexpr double kSameEnd = 1e-9;  // mm
      if (gap.lo_is_end && end.s - gap.lo.s < kSameEnd) return gap.lo;
      if (gap.hi_is_end && gap.hi.s - end.s < kSameEnd) return gap.hi;
      return {end.s, gap.segment, kConcaveSurface, end.t, end.face};
    };
    found_.clear();
    for_each_unknown(gap.lo.s, gap.hi.s,
                     [&](double lo, double hi) { concave.walk(lo, hi, found_); });
    for (const SegmentInterval& f : found_) goal_.take_solved({end_at(f.lo), end_at(f.hi)});
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

}  // namespace frustum::cutter
