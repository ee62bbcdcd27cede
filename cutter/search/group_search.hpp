// The search of a tool's tree of poses for what it covers of a ray, whatever is wanted of that.
//
// Model    : groups that the goal does not want any more are left aside; of the others the
//            representative adds what it covers, and the halves are asked, what promises most
//            first, down to the path segments themselves. What a concave body covers beside its
//            convex parts is asked last. What covers nothing within the span changes nothing, not
//            even the order of the others: segments that are far from a ray may be excluded or not
//            (where there are concave parts ends may differ by their rounding then)
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : as ray_search.hpp
#pragma once

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/box.hpp"
#include "core/constants.hpp"
#include "cutter/search/gap_pieces.hpp"
#include "cutter/search/group_reach.hpp"
#include "cutter/search/prefetch.hpp"
#include "cutter/search/quad_crossing.hpp"
#include "cutter/search/ray_search.hpp"
#include "cutter/search/search_goal.hpp"
#include "cutter/sweep/concave_sweep.hpp"
#include "cutter/sweep/swept_box.hpp"

namespace frustum::cutter {

// What promises most comes first; the goal is as search_goal.hpp has it.
template <class Goal>
class GroupSearch {
 public:
  GroupSearch(const RayQuestion& question, const ToolSweep& sweep, Goal& goal)
      : question_(question),
        sweep_(sweep),
        goal_(goal),
        parts_(sweep.body->parts()),
        quads_(sweep.tree.quads()),
        in_box_(question.ray) {}

  // What is under one group; the root has number 0.
  void run(std::uint32_t group) {
    if (!quads_.empty()) run(std::span(&group, 1));
  }
  void run(std::span<const std::uint32_t> groups) {
    run(groups, [](std::size_t i) { return i; });
  }
  // As given, but that what promises most comes first. `next_open(i)`: the first of them from place
  // i on that may add anything now.
  template <class NextOpen>
  void run(std::span<const std::uint32_t> groups, const NextOpen& next_open) {
    open(groups, next_open);
    finish();
  }

  // The same in steps: what groups promise; on until this is so, if ever; all that is left.
  template <class NextOpen>
  void open(std::span<const std::uint32_t> groups, const NextOpen& next_open) {
    Look look;
    for (std::size_t i = next_open(0); i < groups.size(); i = next_open(i + 1)) {
      // There is something for every ray in the root.
      const bool is_root = groups[i] == 0 && quads_.front().count[0] == 0;
      is_root ? consider(quads_.front().next[0]) : consider(groups[i], look);
    }
  }
  template <class IsMet>
  void run_until(const IsMet& is_met) {
    for (Candidate next; !is_met() && take_best(next);) {
      if (goal_.change() == next.change || goal_.wants(next.group, next.counted)) visit(next);
    }
  }
  void finish() {
    run_until([] { return false; });
    while (has_gaps_to_walk()) walk_gaps();
  }

  // What the cutter covers where this segment begins.
  void take_pose(std::uint32_t segment) {
    take_pose(segment, question_.path->segments[segment].first_pose);
  }
  // At time t of a segment that likely makes an end: if its leaf is asked it comes first.
  void take_likely(std::uint32_t segment, double t) {
    likely_ = segment;
    take_pose(segment, motion_of(segment).at(t), t);
  }
  // What the convex parts cover in this segment, whatever is covered already.
  void solve_parts(std::uint32_t segment) { solve_parts(segment, motion_of(segment)); }
  [[nodiscard]] bool has_solved(std::uint32_t segment) const {
    return std::ranges::find(solved_, segment) != solved_.end();
  }

 private:
  struct Candidate {
    double promise = 0.0;
    RaySpan counted{};  // of its reach
    std::uint32_t group = 0;
    int change = 0;  // of the goal, when it was judged
  };
  // Of equal promises the lower group comes first, whatever else is open.
  [[nodiscard]] static bool is_later(const Candidate& a, const Candidate& b) {
    return a.promise != b.promise ? a.promise < b.promise : a.group > b.group;
  }
  // Between an end of what a concave section's hull sweeps, or of what was known then, and the
  // next: what of it the body covers is asked last, when least is left of it. `is_end`: of the
  // body's own sweep.
  struct Gap {
    std::uint32_t group = 0, segment = 0;
    SweptIntervalEnd lo{}, hi{};
    bool lo_is_end = false, hi_is_end = false;
  };

  // What was seen of a quad while nothing more was covered.
  struct Look {
    const GroupQuad* groups = nullptr;
    int change = 0;
    QuadSpan in_box{};
    std::optional<QuadLimit> limits{};
  };
  // One group: as if it was the only one, whatever of its siblings was looked at before.
  void consider(std::uint32_t index, Look& look) {
    const GroupQuad& groups = quads_[index / kSiblings];
    const std::size_t lane = index % kSiblings;
    if (look.groups != &groups || look.change != goal_.change())
      look = {&groups, goal_.change(), in_box_.within(groups, goal_.span()), std::nullopt};
    if (!is_wanted(groups, index, look.in_box)) return;
    if (!look.limits) look.limits = goal_.limit(groups, look.in_box);
    const GroupLimit limit = (*look.limits)[lane];
    if (!limit.holds) judge(groups, index, limit, {look.in_box.lo[lane], look.in_box.hi[lane]});
  }
  // All groups of a quad.
  void consider(std::uint32_t quad) {
    const GroupQuad& groups = quads_[quad];
    const QuadSpan in_box = in_box_.within(groups, goal_.span());
    std::array<bool, kSiblings> wanted{};
    bool any = false;
    for (std::size_t lane = 0; lane < kSiblings; ++lane) {
      wanted[lane] = is_wanted(groups, number_of(quad, lane), in_box);
      any = any || wanted[lane];
    }
    if (!any) return;
    const QuadLimit limits = goal_.limit(groups, in_box);
    for (std::size_t lane = 0; lane < kSiblings; ++lane) {
      wanted[lane] = wanted[lane] && !limits[lane].holds;
      if (wanted[lane] && limits[lane].counts_representative)
        fetch(&question_.path->poses[groups.representative_pose[lane]], 1);
    }
    for (std::size_t lane = 0; lane < kSiblings; ++lane) {
      if (!wanted[lane]) continue;
      judge(groups, number_of(quad, lane), limits[lane], {in_box.lo[lane], in_box.hi[lane]});
    }
  }
  [[nodiscard]] bool is_wanted(const GroupQuad& groups, std::uint32_t index,
                               const QuadSpan& in_box) {
    const std::size_t lane = index % kSiblings;
    const RaySpan span{in_box.lo[lane], in_box.hi[lane]};
    if (groups.earliest[lane] >= question_.first_excluded || !(span.lo <= span.hi)) return false;
    return goal_.wants(index, goal_.counted({span.lo, span.hi}));
  }
  [[nodiscard]] static std::uint32_t number_of(std::uint32_t quad, std::size_t lane) {
    return kSiblings * quad + static_cast<std::uint32_t>(lane);
  }

  void judge(const GroupQuad& groups, std::uint32_t index, const GroupLimit& limit,
             GroupReach reach) {
    const std::size_t lane = index % kSiblings;
    // Else so far apart that one pose says nothing about the others.
    if (limit.counts_representative && groups.shift[lane] <= sweep_.body->reach()) {
      if (limit.hi == kInfinity) {
        reach = reach_by_representative(groups.group(lane));
      } else {
        take_pose(groups.representative_segment[lane], groups.representative_pose[lane]);
      }
    }
    if (limit.hi < reach.hi) {
      reach.hi = limit.hi;
      reach.hi_slack = 0.0;  // it is in the limit already
    }
    reach.lo = std::max(reach.lo, limit.lo);
    const RaySpan counted = goal_.counted(reach);
    if (!goal_.wants(index, counted)) return;
    add({goal_.promise(reach), counted, index, goal_.change()});
  }

  // Of the open ones the best is kept apart: mostly it is the next at once.
  void add(const Candidate& next) {
    fetch_under(next.group);
    if (!has_best_) {
      best_ = next;
      has_best_ = true;
      return;
    }
    const bool is_better = is_later(best_, next);
    open_.push_back(is_better ? best_ : next);
    std::ranges::push_heap(open_, is_later);
    if (is_better) best_ = next;
  }
  // What may be asked next.
  void fetch_under(std::uint32_t index) const {
    const GroupQuad& groups = quads_[index / kSiblings];
    const std::size_t lane = index % kSiblings;
    if (groups.count[lane] == 0) {
      fetch(&quads_[groups.next[lane]], 1);
      return;
    }
    // Mostly the segments of a leaf are in a row.
    fetch(&sweep_.tree.segments()[groups.next[lane]], 1);
    fetch(&question_.path->segments[groups.representative_segment[lane]], 1);
    fetch(&question_.path->poses[groups.representative_pose[lane]], 3);
  }
  bool take_best(Candidate& next) {
    const bool is_in_heap = !open_.empty() && (!has_best_ || is_later(best_, open_.front()));
    if (is_in_heap) {
      next = open_.front();
      std::ranges::pop_heap(open_, is_later);
      open_.pop_back();
      return true;
    }
    next = best_;
    return std::exchange(has_best_, false);
  }

  // What the parts of the body cover where a segment begins.
  void take_pose(std::uint32_t segment, std::uint32_t at) {
    if (segment < question_.first_excluded) take_pose(segment, question_.path->poses[at], 0.0);
  }
  void take_pose(std::uint32_t segment, const ToolPose& pose, double t) {
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      if (const auto chord = parts_[i].chord(pose, question_.ray))
        take_chord(*chord, segment, i, t);
    }
  }
  void take_chord(const Chord& chord, std::uint32_t segment, std::uint32_t part, double t = 0.0) {
    if (!is_in_span(chord.lo, chord.hi)) return;
    goal_.take(
        {{chord.lo, segment, part, t, chord.lo_face}, {chord.hi, segment, part, t, chord.hi_face}});
  }

  void take_solved(const SweptInterval& solved) {
    if (is_in_span(solved.lo.s, solved.hi.s)) goal_.take_solved(solved);
  }
  [[nodiscard]] bool is_in_span(double lo, double hi) const {
    const RaySpan span = goal_.span();
    return lo <= span.hi && hi >= span.lo;
  }

  GroupReach reach_by_representative(const PoseGroup& group) {
    GroupReach reach = kNoReach;
    const ToolPose& representative = group.representative(*question_.path);
    const auto widen = [&](const Profile& part, const std::optional<Chord>& known) {
      const GroupReach more = reach_of(group, representative, part, question_.ray, known,
                                       {known && goal_.wants_lo(known->lo), true});
      reach.lo = std::min(reach.lo, more.lo);
      reach.hi = std::max(reach.hi, more.hi);
      reach.lo_slack = std::min(reach.lo_slack, more.lo_slack);
      reach.hi_slack = std::min(reach.hi_slack, more.hi_slack);
    };
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      const auto known = parts_[i].chord(representative, question_.ray);
      if (known && group.representative_segment < question_.first_excluded)
        take_chord(*known, group.representative_segment, i);
      widen(parts_[i], known);
    }
    for (const Profile& hull : sweep_.body->concave()) {
      widen(hull, hull.chord(representative, question_.ray));
    }
    return reach;
  }

  void visit(const Candidate& at) {
    const GroupQuad& groups = quads_[at.group / kSiblings];
    const std::uint32_t next = groups.next[at.group % kSiblings];
    const std::size_t count = groups.count[at.group % kSiblings];
    if (count == 0) {
      consider(next);
      return;
    }
    solve_leaf(at, sweep_.tree.segments().subspan(next, count));
  }

  // Those that go deepest into what is not covered come first: they hold back the others.
  void solve_leaf(const Candidate& at, std::span<const std::uint32_t> segments) {
    struct Open {
      double room;
      std::uint32_t segment;
    };
    const LeafMotions leaf = motions_of(segments);
    if (leaf.count == 0) return;
    const DoubleFour rooms = goal_.rooms(leaf, at.counted);
    std::array<Open, kMostInLeaf> open;
    std::size_t count = 0;
    for (std::size_t lane = 0; lane < leaf.count; ++lane) {
      if (rooms[lane] >= 0.0) continue;
      const double room = leaf.segments[lane] == likely_ ? -kInfinity : rooms[lane];
      std::size_t place = count++;
      for (; place > 0 && open[place - 1].room > room; --place) open[place] = open[place - 1];
      open[place] = {room, leaf.segments[lane]};
    }
    const int change = goal_.change();
    for (std::size_t i = 0; i < count; ++i) {
      if (goal_.change() == change || room_of(open[i].segment) < 0.0)
        solve(at.group, open[i].segment);
    }
  }

  [[nodiscard]] LeafMotions motions_of(std::span<const std::uint32_t> segments) const {
    const kinematics::ToolPath& path = *question_.path;
    LeafMotions leaf;
    for (const std::uint32_t segment : segments) {
      if (segment < question_.first_excluded) leaf.segments[leaf.count++] = segment;
    }
    for (std::size_t lane = 0; lane < kMostInLeaf && leaf.count > 0; ++lane) {
      const auto& segment = path.segments[leaf.segments[lane < leaf.count ? lane : 0]];
      leaf.motions.set(lane, path.from(segment), path.to(segment));
    }
    return leaf;
  }

  [[nodiscard]] SegmentMotion motion_of(std::uint32_t segment) const {
    return {*question_.path, question_.path->segments[segment], sweep_.body->reach()};
  }

  [[nodiscard]] double room_of(std::uint32_t segment) const {
    const kinematics::PathSegment& s = question_.path->segments[segment];
    return goal_.room(segment, question_.path->from(s), question_.path->to(s));
  }

  void solve(std::uint32_t group, std::uint32_t segment) {
    const SegmentMotion motion = motion_of(segment);
    if constexpr (Goal::kFollowsFront) {
      if (segment != likely_ && goal_.leaves_for_later(group, motion)) return;
      fetch(&question_.path->blocks[question_.path->segments[segment].block], 1);
    } else {
      if (is_away(group, motion)) return;
    }
    if (!has_solved(segment)) solve_parts(segment, motion);
    const auto sections = sweep_.body->sections();
    if (parts_.size() == sections.size()) return;
    if (ConcaveSweep(*sweep_.body, motion, question_.ray).slides()) {
      walk_later(group, segment, motion);
      return;
    }
    for (auto i = static_cast<std::uint32_t>(parts_.size()); i < sections.size(); ++i) {
      found_.clear();
      append_swept_intervals(sections[i], motion, question_.ray, goal_.known(), found_);
      join_overlapping(found_);
      for (const SegmentInterval& f : found_) take_of_hull(group, motion, swept_of(segment, i, f));
    }
  }

  // Whether the cutter half way, grown by half of its way, covers nothing wanted.
  [[nodiscard]] bool is_away(std::uint32_t group, const SegmentMotion& motion) {
    constexpr double kRounding = 1e-9;  // mm
    GroupReach reach = kNoReach;
    const ToolPose middle = motion.at(0.5);
    for (const Profile& section : sweep_.body->sections()) {
      const auto grown = section.chord(middle, question_.ray, 0.5 * motion.travel() + kRounding);
      if (!grown) continue;
      reach.lo = std::min(reach.lo, grown->lo);
      reach.hi = std::max(reach.hi, grown->hi);
    }
    reach.lo_slack = reach.hi_slack = 0.0;
    return !(reach.lo <= reach.hi) || !goal_.wants(group, goal_.counted(reach));
  }

  void solve_parts(std::uint32_t segment, const SegmentMotion& motion) {
    solved_.push_back(segment);
    for (std::uint32_t i = 0; i < parts_.size(); ++i) {
      found_.clear();
      append_swept_intervals(parts_[i], motion, question_.ray, goal_.floors(), found_);
      for (const SegmentInterval& f : found_) take_solved(swept_of(segment, i, f));
    }
  }

  [[nodiscard]] static SweptInterval swept_of(std::uint32_t segment, std::uint32_t section,
                                              const SegmentInterval& f) {
    return {{f.lo.s, segment, section, f.lo.t, f.lo.face},
            {f.hi.s, segment, section, f.hi.t, f.hi.face}};
  }

  // Wherever the cutter may come to.
  void walk_later(std::uint32_t group, std::uint32_t segment, const SegmentMotion& motion) {
    const Body& body = *sweep_.body;
    const RaySpan in_box =
        BoxCrossing(question_.ray)
            .within(swept_box({0.0, body.height(), body.max_radius()}, motion), goal_.span());
    for_each_unknown(in_box.lo, in_box.hi, [&](double lo, double hi) {
      Gap gap{group, segment};
      gap.lo.s = lo;
      gap.hi.s = hi;
      gaps_.push_back(gap);
    });
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
    for (const Gap& c : covered_) take_solved({c.lo, c.hi});
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

  // What begins too far ahead waits until more is covered.
  [[nodiscard]] bool has_gaps_to_walk() const {
    return !gaps_.empty() && (walked_at_ != goal_.change() || walked_ != gaps_.size());
  }
  void walk_gaps() {
    std::erase_if(gaps_, [&](const Gap& gap) {
      return !goal_.wants_piece(gap.group, gap.lo.s, gap.hi.s) || room_of(gap.segment) >= 0.0;
    });
    walked_at_ = goal_.change();
    walked_ = gaps_.size();
    near_.clear();
    for (const Gap& gap : gaps_) {
      const double from = std::max(gap.lo.s, goal_.span().lo);
      near_.push_back({gap.segment, from, std::max(from, std::min(gap.hi.s, goal_.begins_by()))});
    }
    for (const GapPiece& piece : pieces_to_walk(question_, *sweep_.body, near_)) {
      const Gap& gap = gaps_[piece.gap];
      walk(gap, piece.lo, piece.hi == near_[piece.gap].hi ? gap.hi.s : piece.hi);
    }
    // Else they may count when more is covered.
    if (goal_.begins_by() == kInfinity) gaps_.clear();
  }
  void walk(const Gap& gap, double from, double to) {
    if (!goal_.wants_piece(gap.group, from, to) || room_of(gap.segment) >= 0.0) return;
    const SegmentMotion motion = motion_of(gap.segment);
    const ConcaveSweep concave(*sweep_.body, motion, question_.ray);
    const auto end_at = [&](const SweptEnd& end) -> SweptIntervalEnd {
      constexpr double kSameEnd = 1e-9;  // mm
      if (gap.lo_is_end && end.s - gap.lo.s < kSameEnd) return gap.lo;
      if (gap.hi_is_end && gap.hi.s - end.s < kSameEnd) return gap.hi;
      return {end.s, gap.segment, kConcaveSurface, end.t, end.face};
    };
    found_.clear();
    for_each_unknown(
        from, to, [&](double lo, double hi) { concave.walk(lo, hi, found_, goal_.begins_by()); });
    for (const SegmentInterval& f : found_) take_solved({end_at(f.lo), end_at(f.hi)});
  }

  const RayQuestion& question_;
  const ToolSweep& sweep_;
  Goal& goal_;
  std::span<const Profile> parts_;
  std::span<const GroupQuad> quads_;
  QuadCrossing in_box_;
  std::optional<std::uint32_t> likely_{};
  boost::container::small_vector<Candidate, 32> open_{};  // a heap by promise
  Candidate best_{};
  bool has_best_ = false;
  // Of these the goal has what the parts cover, or needs it no more.
  boost::container::small_vector<std::uint32_t, 16> solved_{};
  FewSegmentIntervals found_{};
  std::vector<Gap> gaps_{}, covered_{};
  std::vector<RayGap> near_{};
  // When the gaps were walked, by the goal's change, and how many there were.
  int walked_at_ = -1;
  std::size_t walked_ = 0;
};

}  // namespace frustum::cutter
