#include "core/interval_set.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace frustum {
namespace {

// Sets with ends on whole numbers, so that brute force can look at every half: what holds on both
// sides of every possible end holds everywhere.
constexpr int kSpan = 12;
using Membership = std::array<bool, kSpan>;  // entry i: the open interval (i, i + 1)

std::vector<Interval> intervals_of(const std::vector<std::pair<int, int>>& raw, EndTag first_tag) {
  std::vector<Interval> intervals;
  for (const auto& [a, b] : raw) {
    intervals.push_back({static_cast<double>(a), static_cast<double>(b), first_tag, first_tag + 1});
    first_tag += 2;
  }
  return intervals;
}

rc::Gen<std::vector<std::pair<int, int>>> raw_intervals() {
  return rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(0, kSpan + 1), rc::gen::inRange(0, kSpan + 1)));
}

Membership membership(const std::vector<Interval>& intervals) {
  Membership inside{};
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const double s = static_cast<double>(i) + 0.5;
    inside[i] = std::any_of(intervals.begin(), intervals.end(),
                            [s](const Interval& x) { return x.lo < s && s < x.hi; });
  }
  return inside;
}
Membership membership(const IntervalSet& set) {
  return membership({set.intervals().begin(), set.intervals().end()});
}

bool is_normal(const IntervalSet& set) {
  double end = -std::numeric_limits<double>::infinity();
  for (const Interval& i : set.intervals()) {
    if (!(i.lo < i.hi) || !(i.lo > end)) return false;
    end = i.hi;
  }
  return true;
}

// Every end of `result` is an end of one of the originating_blocks at the same place and under the
// same tag.
bool ends_are_known(const IntervalSet& result, const std::vector<Interval>& originating_blocks) {
  const auto known = [&originating_blocks](double at, EndTag tag) {
    return std::any_of(originating_blocks.begin(), originating_blocks.end(),
                       [=](const Interval& m) {
                         return (m.lo == at && m.lo_tag == tag) || (m.hi == at && m.hi_tag == tag);
                       });
  };
  return std::all_of(result.intervals().begin(), result.intervals().end(), [&](const Interval& i) {
    return known(i.lo, i.lo_tag) && known(i.hi, i.hi_tag);
  });
}

template <typename Operation>
Membership combined(const Membership& a, const Membership& b, Operation operation) {
  Membership result{};
  std::transform(a.begin(), a.end(), b.begin(), result.begin(), operation);
  return result;
}

struct Pair {
  std::vector<Interval> a;
  std::vector<Interval> b;

  [[nodiscard]] std::vector<Interval> both() const {
    std::vector<Interval> all = a;
    all.insert(all.end(), b.begin(), b.end());
    return all;
  }
};
Pair any_pair() {
  return {intervals_of(*raw_intervals(), 0), intervals_of(*raw_intervals(), 1000)};
}

RC_GTEST_PROP(IntervalSetLaws, ConstructionIsTheUnionOfItsIntervals, ()) {
  const std::vector<Interval> raw = any_pair().a;
  const IntervalSet set(raw);
  RC_ASSERT(is_normal(set));
  RC_ASSERT(membership(set) == membership(raw));
  RC_ASSERT(ends_are_known(set, raw));
}

RC_GTEST_PROP(IntervalSetLaws, ConstructionDoesNotDependOnTheOrder, ()) {
  std::vector<Interval> raw = any_pair().a;
  const IntervalSet forward(raw);
  std::reverse(raw.begin(), raw.end());
  const IntervalSet backward(raw);
  RC_ASSERT(std::ranges::equal(forward.intervals(), backward.intervals()));
}

RC_GTEST_PROP(IntervalSetLaws, UnionHoldsWhatEitherHolds, ()) {
  const Pair pair = any_pair();
  const IntervalSet result = IntervalSet(pair.a).united(IntervalSet(pair.b));
  RC_ASSERT(is_normal(result));
  RC_ASSERT(membership(result) ==
            combined(membership(pair.a), membership(pair.b), std::logical_or<>{}));
  RC_ASSERT(ends_are_known(result, pair.both()));
}

RC_GTEST_PROP(IntervalSetLaws, IntersectionHoldsWhatBothHold, ()) {
  const Pair pair = any_pair();
  const IntervalSet result = IntervalSet(pair.a).intersected(IntervalSet(pair.b));
  RC_ASSERT(is_normal(result));
  RC_ASSERT(membership(result) ==
            combined(membership(pair.a), membership(pair.b), std::logical_and<>{}));
  RC_ASSERT(ends_are_known(result, pair.both()));
}

RC_GTEST_PROP(IntervalSetLaws, DifferenceHoldsWhatIsNotRemoved, ()) {
  const Pair pair = any_pair();
  const IntervalSet result = IntervalSet(pair.a).minus(IntervalSet(pair.b));
  RC_ASSERT(is_normal(result));
  RC_ASSERT(membership(result) == combined(membership(pair.a), membership(pair.b),
                                           [](bool in_a, bool in_b) { return in_a && !in_b; }));
  RC_ASSERT(ends_are_known(result, pair.both()));
}

RC_GTEST_PROP(IntervalSetLaws, RemovalIsMonotoneIdempotentAndOrderFree, ()) {
  const IntervalSet blank(any_pair().a);
  const Pair cuts = any_pair();
  const IntervalSet first(cuts.a);
  const IntervalSet second(cuts.b);
  const IntervalSet once = blank.minus(first);
  RC_ASSERT(once.length() <= blank.length());
  RC_ASSERT(std::ranges::equal(once.minus(first).intervals(), once.intervals()));
  RC_ASSERT(membership(once.minus(second)) == membership(blank.minus(second).minus(first)));
  RC_ASSERT(membership(once.minus(second)) == membership(blank.minus(first.united(second))));
}

RC_GTEST_PROP(IntervalSetLaws, LengthsAdd, ()) {
  const Pair pair = any_pair();
  const IntervalSet a(pair.a);
  const IntervalSet b(pair.b);
  RC_ASSERT(a.length() + b.length() == a.united(b).length() + a.intersected(b).length());
  RC_ASSERT(a.length() == a.minus(b).length() + a.intersected(b).length());
}

RC_GTEST_PROP(IntervalSetLaws, CoversAgreesWithEveryPointBetween, ()) {
  const IntervalSet set(any_pair().a);
  const int lo = *rc::gen::inRange(0, kSpan);
  const int hi = *rc::gen::inRange(lo + 1, kSpan + 1);
  const Membership inside = membership(set);
  const bool all =
      std::all_of(inside.begin() + lo, inside.begin() + hi, [](bool in) { return in; });
  RC_ASSERT(set.covers(lo, hi) == all);
  RC_ASSERT(set.contains(lo + 0.5) == inside[static_cast<std::size_t>(lo)]);
}

TEST(IntervalSet, IsEmptyByDefault) {
  const IntervalSet set;
  EXPECT_TRUE(set.empty());
  EXPECT_EQ(set.length(), 0.0);
  EXPECT_FALSE(set.contains(0.0));
  EXPECT_FALSE(set.covers(0.0, 1.0));
}

TEST(IntervalSet, DropsWhatIsEmptyReversedOrNotANumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(IntervalSet({{1, 1}, {2, 1}, {kNan, 1}, {0, kNan}}).empty());
}

TEST(IntervalSet, IsClosed) {
  const IntervalSet set({{1, 2}, {4, 6}});
  for (const double s : {1.0, 1.5, 2.0, 4.0, 6.0}) EXPECT_TRUE(set.contains(s)) << s;
  for (const double s : {0.9, 2.1, 3.9, 6.1}) EXPECT_FALSE(set.contains(s)) << s;
  EXPECT_TRUE(set.covers(4, 6));
  EXPECT_FALSE(set.covers(1.5, 4.5));
}

TEST(IntervalSet, JoinsIntervalsThatTouch) {
  const IntervalSet set({{2, 3, 20, 21}, {1, 2, 10, 11}});
  ASSERT_EQ(set.intervals().size(), 1U);
  EXPECT_EQ(set.intervals()[0], (Interval{1, 3, 10, 21}));
}

TEST(IntervalSet, KeepsAGapOfOneRounding) {
  const double gap = std::nextafter(2.0, 3.0);
  EXPECT_EQ(IntervalSet({{1, 2}, {gap, 3}}).intervals().size(), 2U);
}

TEST(IntervalSet, TagsFollowTheEndsThatMadeThem) {
  const IntervalSet blank({{0, 10, 1, 2}});
  const IntervalSet sweep({{2, 3, 20, 21}, {5, 12, 30, 31}});
  const IntervalSet left = blank.minus(sweep);
  ASSERT_EQ(left.intervals().size(), 2U);
  EXPECT_EQ(left.intervals()[0], (Interval{0, 2, 1, 20}));
  EXPECT_EQ(left.intervals()[1], (Interval{3, 5, 21, 30}));
  const IntervalSet shared = blank.intersected(sweep);
  ASSERT_EQ(shared.intervals().size(), 2U);
  EXPECT_EQ(shared.intervals()[0], (Interval{2, 3, 20, 21}));
  EXPECT_EQ(shared.intervals()[1], (Interval{5, 10, 30, 2}));
}

TEST(IntervalSet, RemovingWhatOnlyTouchesRemovesNothing) {
  const IntervalSet blank({{1, 2, 5, 6}});
  EXPECT_TRUE(std::ranges::equal(blank.minus(IntervalSet({{0, 1}, {2, 3}})).intervals(),
                                 blank.intervals()));
}

TEST(IntervalSet, ReachesToInfinity) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const IntervalSet line({{-kInf, kInf, 1, 2}});
  const IntervalSet rest = line.minus(IntervalSet({{0, 1, 3, 4}}));
  ASSERT_EQ(rest.intervals().size(), 2U);
  EXPECT_TRUE(rest.contains(-1e300));
  EXPECT_FALSE(rest.contains(0.5));
  EXPECT_EQ(rest.intervals()[1].lo_tag, 4);
}

}  // namespace
}  // namespace frustum
