#include "cutter/search/ray_search.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "core/constants.hpp"
#include "cutter/search/group_search.hpp"
#include "cutter/search/separating_plane.hpp"
#include "cutter/search/whole_sweep.hpp"

namespace frustum::cutter {
namespace {

// Parts of a cutter that meet touch within this (mm): rounding of their ends.
constexpr double kJoined = 1e-11;

// Everything within the span, where the body has concave sections: what these cover is found from
// what is covered already.
class WholeSweptInterval {
 public:
  // `swept` is what other tools cover: their ends have no planes here.
  WholeSweptInterval(const RaySpan& span, const EndPlanes& planes,
                     std::span<const SweptInterval> swept)
      : span_(span), planes_(planes) {
    for (const SweptInterval& c : swept)
      swept_.push_back({c, SeparatingPlane(), SeparatingPlane()});
  }

  [[nodiscard]] std::vector<SweptInterval> swept() const {
    std::vector<SweptInterval> all;
    for (const BoundedInterval& c : swept_) all.push_back(c.interval);
    return all;
  }

  [[nodiscard]] const RaySpan& span() const { return span_; }
  [[nodiscard]] static bool wants_lo(double) { return true; }
  [[nodiscard]] static double promise(const GroupReach& reach) { return reach.hi - reach.lo; }
  [[nodiscard]] int change() const { return change_; }

  static constexpr bool kFollowsFront = false;
  [[nodiscard]] static RaySpan counted(const GroupReach& reach) {
    return {reach.lo + reach.lo_slack, reach.hi - reach.hi_slack};
  }
  [[nodiscard]] bool wants(std::uint32_t, const RaySpan& counted) const {
    const double lo = std::max(counted.lo, span_.lo);
    const double hi = std::min(counted.hi, span_.hi);
    if (!(lo <= hi)) return false;
    return std::ranges::none_of(swept_, [&](const BoundedInterval& c) {
      return c.interval.lo.s <= lo && hi <= c.interval.hi.s;
    });
  }
  [[nodiscard]] bool wants_piece(std::uint32_t group, double lo, double hi) const {
    return wants(group, {lo, hi});
  }
  [[nodiscard]] static double begins_by() { return kInfinity; }

  [[nodiscard]] QuadLimit limit(const GroupQuad& groups, const QuadSpan&) {
    const Held held = between([&](const SeparatingPlane& end) {
      const DoubleFour most = end.overreach(groups).most;
      return Held{most[0] <= 0.0, most[1] <= 0.0, most[2] <= 0.0, most[3] <= 0.0};
    });
    return {GroupLimit{.holds = held[0]}, GroupLimit{.holds = held[1]},
            GroupLimit{.holds = held[2]}, GroupLimit{.holds = held[3]}};
  }
  [[nodiscard]] double room(std::uint32_t, const ToolPose& from, const ToolPose& to) {
    const bool held = between([&](const SeparatingPlane& end) {
      const bool by = end.holds(from, to);
      return Held{by, by, by, by};
    })[0];
    return held ? 0.0 : -1.0;
  }
  [[nodiscard]] DoubleFour rooms(const LeafMotions& leaf, const RaySpan&) {
    const Held held = between([&](const SeparatingPlane& end) {
      const DoubleFour room = end.rooms(leaf.motions, kSearchTolerance);
      return Held{room[0] >= 0.0, room[1] >= 0.0, room[2] >= 0.0, room[3] >= 0.0};
    });
    DoubleFour rooms;
    for (std::size_t k = 0; k < kSiblings; ++k) rooms[k] = held[k] ? 0.0 : -1.0;
    return rooms;
  }

  [[nodiscard]] std::span<const Chord> known() {
    known_.clear();
    for (const BoundedInterval& c : swept_) known_.push_back({c.interval.lo.s, c.interval.hi.s});
    return known_;
  }
  [[nodiscard]] std::span<const Chord> floors() { return known(); }
  void take_solved(const SweptInterval& next) { take(next); }

  void take(const SweptInterval& next) {
    // The intervals that touch it become one with it; a tie keeps the older end.
    ++change_;
    auto first = swept_.begin();
    while (first != swept_.end() && first->interval.hi.s < next.lo.s - kJoined) ++first;
    auto last = first;
    BoundedInterval joined{next, std::nullopt, std::nullopt};
    for (; last != swept_.end() && last->interval.lo.s <= next.hi.s + kJoined; ++last) {
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
      swept_.insert(first, joined);
      return;
    }
    *first = joined;
    swept_.erase(first + 1, last);
  }

 private:
  struct BoundedInterval {
    SweptInterval interval{};
    std::optional<SeparatingPlane> lo{}, hi{};  // made when first asked for
  };
  // Whether each of four is between the ends of one interval, both of which hold it back.
  using Held = std::array<bool, kSiblings>;
  [[nodiscard]] static bool any(const Held& held) {
    return held[0] || held[1] || held[2] || held[3];
  }
  template <class HeldBy>
  [[nodiscard]] Held between(const HeldBy& held_by) {
    Held all{};
    for (BoundedInterval& c : swept_) {
      Held by{true, true, true, true};
      if (c.interval.hi.s < span_.hi) {
        if (!c.hi) c.hi = planes_.at(c.interval.hi, true);
        by = held_by(*c.hi);
      }
      if (any(by) && c.interval.lo.s > span_.lo) {
        if (!c.lo) c.lo = planes_.at(c.interval.lo, false);
        const Held by_lo = held_by(*c.lo);
        for (std::size_t k = 0; k < kSiblings; ++k) by[k] = by[k] && by_lo[k];
      }
      for (std::size_t k = 0; k < kSiblings; ++k) all[k] = all[k] || by[k];
      if (all[0] && all[1] && all[2] && all[3]) break;
    }
    return all;
  }

  RaySpan span_;
  const EndPlanes& planes_;
  std::vector<BoundedInterval> swept_{};
  std::vector<Chord> known_{};
  int change_ = 0;
};

}  // namespace

void extend_swept_interval(const RayQuestion& question, const ToolSweep& sweep,
                           std::vector<SweptInterval>& swept) {
  const EndPlanes planes(question, *sweep.body);
  if (!sweep.body->concave().empty()) {
    WholeSweptInterval goal(question.span, planes, swept);
    GroupSearch(question, sweep, goal).run(0);
    swept = goal.swept();
    return;
  }
  WholeSweep goal(question, sweep, planes, swept);
  GroupSearch search(question, sweep, goal);
  search.run(0);
  while (const auto segment = goal.unsolved()) {
    search.solve_parts(*segment);
    goal.settle(*segment);
  }
  swept = goal.swept();
}

}  // namespace frustum::cutter
