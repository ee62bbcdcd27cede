#include "cutter/search/ray_search.hpp"

#include <algorithm>
#include <optional>

#include "core/constants.hpp"
#include "cutter/search/group_search.hpp"
#include "cutter/search/path_climb.hpp"
#include "cutter/search/separating_plane.hpp"
#include "cutter/search/whole_sweep.hpp"

namespace frustum::cutter {
namespace {

// Only what continues the swept interval from the front.
class Front {
 public:
  Front(const RaySpan& span, const EndPlanes& planes, double gap, SweptIntervalEnd& front)
      : span_(span), planes_(planes), gap_(gap), front_(front) {}

  [[nodiscard]] RaySpan span() const { return {front_.s - gap_, span_.hi}; }

  [[nodiscard]] bool wants_lo(double lo) const { return lo > front_.s + gap_; }
  [[nodiscard]] static double promise(const GroupReach& reach) { return reach.hi; }
  [[nodiscard]] int change() const { return change_; }

  // What begins beyond the front is asked again when the front has come there.
  [[nodiscard]] static RaySpan counted(const GroupReach& reach) {
    return {reach.lo, reach.hi - reach.hi_slack};
  }
  [[nodiscard]] bool wants(std::uint32_t group, const RaySpan& counted) {
    if (!(counted.lo <= counted.hi) || counted.hi <= front_.s) return false;
    if (counted.lo <= front_.s + gap_) return true;
    deferred_.push_back({counted.lo, group});
    return false;
  }
  [[nodiscard]] bool wants_piece(std::uint32_t group, double lo, double hi) {
    return wants(group, {lo, hi});
  }

  // Whatever a group covers before the front does not matter.
  [[nodiscard]] PairLimit limit(const GroupPair& groups) {
    if (change_ == 0) return {};
    const Overreach over = plane().overreach(groups);
    const auto of = [&](std::size_t half) {
      return GroupLimit{over.most[half] <= 0.0,
                        over.height[half] < 0.0 || over.most[half] == kInfinity,
                        front_.s + over.most[half]};
    };
    return {of(0), of(1)};
  }
  [[nodiscard]] double room(std::uint32_t, const ToolPose& from, const ToolPose& to) {
    return change_ > 0 ? plane().room(from, to) : -kInfinity;
  }

  [[nodiscard]] std::span<const Chord> known() {
    known_ = {-kInfinity, front_.s};
    return {&known_, 1};
  }
  [[nodiscard]] std::span<const Chord> floors() { return known(); }
  void take_solved(const SweptInterval& next) { take(next); }

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
  [[nodiscard]] const SeparatingPlane& plane() {
    if (!plane_) plane_ = planes_.at(front_, true);
    return *plane_;
  }

  void move_to(const SweptIntervalEnd& end) {
    front_ = end;
    plane_.reset();
    ++change_;
  }

  struct Deferred {
    double lo;
    std::uint32_t group;
  };
  RaySpan span_;
  const EndPlanes& planes_;
  double gap_;
  SweptIntervalEnd& front_;
  std::optional<SeparatingPlane> plane_{};  // at the front; made when first asked for
  std::vector<Deferred> deferred_{};
  std::vector<SweptInterval> ahead_{};
  Chord known_{};
  int change_ = 0;
};

}  // namespace

void extend_swept_interval(const RayQuestion& question, const ToolSweep& sweep,
                           std::vector<SweptInterval>& swept) {
  const EndPlanes planes(question, *sweep.body);
  WholeSweep goal(question, sweep, planes, swept);
  GroupSearch search(question, sweep, goal);
  search.run(0);
  while (const auto segment = goal.unsolved()) {
    search.solve_parts(*segment);
    goal.settle(*segment);
  }
  swept = goal.swept();
}

bool advance_front(const RayQuestion& question, const ToolSweep& sweep, double gap,
                   SweptIntervalEnd& front) {
  constexpr std::uint32_t kRoot = 0;
  if (sweep.tree.empty()) return false;
  return advance_front(question, sweep, gap, {&kRoot, 1}, {}, front);
}

bool advance_front(const RayQuestion& question, const ToolSweep& sweep, double gap,
                   std::span<const std::uint32_t> groups, std::span<const std::uint32_t> first,
                   SweptIntervalEnd& front) {
  const EndPlanes planes(question, *sweep.body);
  Front goal(question.span, planes, gap, front);
  GroupSearch search(question, sweep, goal);
  for (const std::uint32_t segment : first) {
    search.solve_parts(climbed(question, *sweep.body, segment, true));
  }
  search.run(groups);
  while (const auto group = goal.next_deferred()) search.run(*group);
  return goal.moved();
}

}  // namespace frustum::cutter
