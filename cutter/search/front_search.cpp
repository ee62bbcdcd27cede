#include "cutter/search/front_search.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "core/constants.hpp"
#include "cutter/search/axis_distance.hpp"
#include "cutter/search/group_search.hpp"
#include "cutter/search/path_climb.hpp"
#include "cutter/search/pose_descent.hpp"
#include "cutter/search/separating_plane.hpp"
#include "cutter/search/whole_sweep.hpp"

namespace frustum::cutter {
namespace {

// Whether the body surely stays farther than `by` from a point on its whole way: in the middle of
// every part of the motion it is farther than it can come. At most 15 distances are asked.
bool stays_away(const Body& body, const SegmentMotion& motion, const Vec3& point, double by,
                double middle = 0.5, double half = 0.5) {
  // Of shorter parts, and nearer than this share of the way, a solution costs less than a proof.
  constexpr double kShortest = 0.1, kNear = 0.15;
  const double way = half * motion.travel();
  const double distance = body.distance(motion.at(middle), point);
  if (distance > way + by) return true;
  if (half < kShortest || !(distance > kNear * way + by)) return false;
  const double part = 0.5 * half;
  return stays_away(body, motion, point, by, middle - part, part) &&
         stays_away(body, motion, point, by, middle + part, part);
}

// Only what continues the swept interval from the front.
class Front {
 public:
  Front(const RayQuestion& question, const Body& body, const EndPlanes& planes, double gap,
        SweptIntervalEnd& front)
      : ray_(question.ray),
        body_(body),
        span_(question.span),
        planes_(planes),
        gap_(gap),
        front_(front) {}

  [[nodiscard]] RaySpan span() const { return {front_.s - gap_, span_.hi}; }

  [[nodiscard]] bool wants_lo(double lo) const { return lo > front_.s + gap_; }
  [[nodiscard]] static double promise(const GroupReach& reach) { return reach.hi; }
  [[nodiscard]] int change() const { return change_; }

  // What begins beyond the front is asked again when the front has come there.
  static constexpr bool kFollowsFront = true;
  [[nodiscard]] static RaySpan counted(const GroupReach& reach) {
    return {reach.lo, reach.hi - reach.hi_slack};
  }
  [[nodiscard]] bool wants(std::uint32_t group, const RaySpan& counted) {
    if (!(counted.lo <= counted.hi) || counted.hi <= front_.s) return false;
    if (counted.lo <= front_.s + gap_) return true;
    defer(group, counted.lo);
    return false;
  }
  [[nodiscard]] bool wants_piece(std::uint32_t group, double lo, double hi) {
    return wants(group, {lo, hi});
  }
  [[nodiscard]] double begins_by() const { return front_.s + gap_; }

  // From now on whether groups are at the front is asked wherever that is, not only where it
  // begins: worth it for what fans leave of a list.
  void ask_places() { asks_places_ = true; }

  // Whatever a group covers before the front does not matter. What no cutter of which is at the
  // front begins beyond it, if at all.
  [[nodiscard]] QuadLimit limit(const GroupQuad& groups, const QuadSpan&) {
    QuadLimit limits;
    bool is_open = change_ == 0;
    if (change_ > 0) {
      const Overreach over = plane().overreach(groups);
      for (std::size_t lane = 0; lane < kSiblings; ++lane) {
        limits[lane] = {over.most[lane] <= 0.0,
                        over.height[lane] < 0.0 || over.most[lane] == kInfinity,
                        front_.s + over.most[lane]};
        is_open = is_open || !(limits[lane].holds || groups.is_free(lane));
      }
    }
    if (!is_open || (change_ > 0 && !asks_places_)) return limits;
    const auto away = axes().are_away(groups);
    for (std::size_t lane = 0; lane < kSiblings; ++lane) {
      if (away[lane] && !limits[lane].holds)
        limits[lane] = {.counts_representative = false, .lo = well_beyond()};
    }
    return limits;
  }
  [[nodiscard]] bool leaves_for_later(std::uint32_t group, const SegmentMotion& motion) {
    if (!stays_away(body_, motion, ray_.at(front_.s), 2.0 * gap_)) return false;
    defer(group, well_beyond());
    return true;
  }
  [[nodiscard]] double room(std::uint32_t, const ToolPose& from, const ToolPose& to) {
    if (change_ == 0) return -kInfinity;
    return plane().room(from, to);
  }
  [[nodiscard]] DoubleFour rooms(const LeafMotions& leaf, const RaySpan&) {
    if (change_ == 0) return four_of(-kInfinity);
    return plane().rooms(leaf.motions, kSearchTolerance);
  }

  [[nodiscard]] std::span<const Chord> known() {
    known_ = {-kInfinity, front_.s};
    return {&known_, 1};
  }
  [[nodiscard]] std::span<const Chord> floors() { return known(); }
  void take_solved(const SweptInterval& next) {
    const int change = change_;
    take(next);
    if (change_ != change) by_pose_ = false;
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
  // A pose of a group, or of an interval ahead, got there last, not a solution.
  [[nodiscard]] bool is_by_pose() const { return by_pose_; }
  [[nodiscard]] const SweptIntervalEnd& end() const { return front_; }
  // Precondition: it has moved.
  [[nodiscard]] const SeparatingPlane& plane() {
    if (!plane_) plane_ = planes_.at(front_, true);
    return *plane_;
  }

 private:
  void move_to(const SweptIntervalEnd& end) {
    front_ = end;
    by_pose_ = true;
    plane_.reset();
    axes_.reset();
    ++change_;
  }

  // Until the front has come to where the first of what is put aside of the group begins.
  void defer(std::uint32_t group, double lo) {
    if (!deferred_.empty() && deferred_.back().group == group) {
      deferred_.back().lo = std::min(deferred_.back().lo, lo);
    } else {
      deferred_.push_back({lo, group});
    }
  }
  // Farther than what is at the front may begin.
  [[nodiscard]] double well_beyond() const { return front_.s + 2.0 * gap_; }
  [[nodiscard]] const AxisDistance& axes() {
    if (!axes_) axes_.emplace(ray_.at(front_.s), body_);
    return *axes_;
  }

  struct Deferred {
    double lo;
    std::uint32_t group;
  };
  const Ray& ray_;
  const Body& body_;
  RaySpan span_;
  const EndPlanes& planes_;
  double gap_;
  SweptIntervalEnd& front_;
  // At the front; made when first asked for.
  std::optional<AxisDistance> axes_{};
  std::optional<SeparatingPlane> plane_{};
  std::vector<Deferred> deferred_{};
  std::vector<SweptInterval> ahead_{};
  Chord known_{};
  int change_ = 0;
  bool by_pose_ = false;
  bool asks_places_ = false;
};

// What fans hold back of a list of groups as the front moves. A fan is made where the front is
// before any group is asked, and only there: so the fans that later rays find do not depend on
// groups of the list that cover nothing of this one.
class FrontFans {
 public:
  FrontFans(Front& goal, const ToolSweep& sweep, std::span<const std::uint32_t> groups,
            EndFans* fans)
      : goal_(goal), fans_(fans), held_(groups.size()) {
    if (fans_ == nullptr || !goal_.moved()) return;
    look(fans_->of(maker(), goal_.plane(), sweep.tree.quads(), groups), 0);
  }

  // The first group from place i on that may add anything now.
  [[nodiscard]] std::size_t next_open(std::size_t i) {
    if (fans_ == nullptr || !goal_.moved()) return i;
    if (goal_.change() != change_) look(fans_->near_by(maker(), goal_.plane()), i);
    return held_.next_open(i);
  }

 private:
  [[nodiscard]] EndFans::Maker maker() const { return {goal_.end().section, goal_.end().face}; }
  void look(const EndFan* fan, std::size_t from) {
    change_ = goal_.change();
    const EndFan none;
    const EndFan& by = fan != nullptr ? *fan : none;
    by.find_held(by.beside(goal_.plane().end(), goal_.plane().beyond()), from / 4, held_.by_four());
  }

  Front& goal_;
  EndFans* fans_;
  HeldGroups held_;
  int change_ = 0;
};

// Segments that are likely are asked first, then groups, and from where one of these gets farther
// the path along.
class FrontSearch {
 public:
  FrontSearch(const RayQuestion& question, const ToolSweep& sweep, double gap,
              SweptIntervalEnd& front)
      : question_(question),
        sweep_(sweep),
        planes_(question, *sweep.body),
        goal_(question, *sweep.body, planes_, gap, front),
        search_(question, sweep, goal_) {}

  // From a segment along the path to what likely makes the end.
  void climb_from(std::uint32_t segment) {
    const std::uint32_t likely = climbed(question_, sweep_, segment, true).segment;
    if (!search_.has_solved(likely)) search_.solve_parts(likely);
    if (!goal_.moved() || goal_.end().segment != likely) return;
    const auto next = next_at(question_, sweep_, likely, goal_.end().t);
    if (next && !search_.has_solved(*next)) search_.solve_parts(*next);
  }

  // On to what likely is at a point, and from there along the path.
  void descend_to(const Vec3& point) {
    const auto there = likely_segment_at(point, question_, sweep_);
    if (!there) return;
    const ClimbTop likely = climbed(question_, sweep_, *there, true);
    search_.take_likely(likely.segment, likely.t);
  }

  void ask(std::span<const std::uint32_t> groups, EndFans* fans) {
    constexpr int kMostClimbs = 4;  // other passes that the front may come to one by one
    int change = goal_.change();
    const auto is_by_pose = [&] { return goal_.change() != change && goal_.is_by_pose(); };
    if (fans != nullptr) goal_.ask_places();
    FrontFans held(goal_, sweep_, groups, fans);
    search_.open(groups, [&](std::size_t i) { return held.next_open(i); });
    for (int i = 0; i < kMostClimbs; ++i) {
      search_.run_until(is_by_pose);
      if (!is_by_pose()) break;
      climb_from(goal_.end().segment);
      change = goal_.change();
    }
    search_.finish();
    while (const auto group = goal_.next_deferred()) search_.run(*group);
  }

  [[nodiscard]] bool moved() const { return goal_.moved(); }

 private:
  const RayQuestion& question_;
  const ToolSweep& sweep_;
  EndPlanes planes_;
  Front goal_;
  GroupSearch<Front> search_;
};

}  // namespace

bool advance_front(const RayQuestion& question, const ToolSweep& sweep, double gap,
                   SweptIntervalEnd& front) {
  if (sweep.tree.empty()) return false;
  FrontSearch search(question, sweep, gap, front);
  search.descend_to(question.ray.at(front.s));
  constexpr std::uint32_t kRoot = 0;
  search.ask({&kRoot, 1}, nullptr);
  return search.moved();
}

bool advance_front(const RayQuestion& question, const ToolSweep& sweep, double gap,
                   std::span<const std::uint32_t> groups, std::span<const std::uint32_t> first,
                   EndFans* fans, SweptIntervalEnd& front) {
  FrontSearch search(question, sweep, gap, front);
  for (const std::uint32_t segment : first) search.climb_from(segment);
  search.ask(groups, fans);
  return search.moved();
}

}  // namespace frustum::cutter
