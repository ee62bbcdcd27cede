#include "core/interval_set.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace frustum {

IntervalSet::IntervalSet(std::vector<Interval> intervals) : intervals_(std::move(intervals)) {
  std::erase_if(intervals_, [](const Interval& i) { return !(i.lo < i.hi); });
  if (intervals_.size() < 2) return;
  // Ties are broken by the tag, so that the result does not depend on the order of the input.
  std::sort(intervals_.begin(), intervals_.end(), [](const Interval& a, const Interval& b) {
    return std::tie(a.lo, a.lo_tag, a.hi, a.hi_tag) < std::tie(b.lo, b.lo_tag, b.hi, b.hi_tag);
  });
  auto last = intervals_.begin();
  for (auto next = std::next(last); next != intervals_.end(); ++next) {
    if (next->lo > last->hi) {
      *++last = *next;
    } else if (next->hi > last->hi) {
      last->hi = next->hi;
      last->hi_tag = next->hi_tag;
    }
  }
  intervals_.erase(std::next(last), intervals_.end());
}

double IntervalSet::length() const {
  double sum = 0.0;
  for (const Interval& i : intervals_) sum += i.length();
  return sum;
}

bool IntervalSet::contains(double s) const { return covers(s, s); }

bool IntervalSet::covers(double lo, double hi) const {
  const auto after = std::upper_bound(intervals_.begin(), intervals_.end(), lo,
                                      [](double s, const Interval& i) { return s < i.lo; });
  return after != intervals_.begin() && hi <= std::prev(after)->hi;
}

IntervalSet IntervalSet::united(const IntervalSet& other) const {
  std::vector<Interval> all = intervals_;
  all.insert(all.end(), other.intervals_.begin(), other.intervals_.end());
  return IntervalSet(std::move(all));
}

IntervalSet IntervalSet::intersected(const IntervalSet& other) const {
  IntervalSet both;
  auto a = intervals_.begin();
  auto b = other.intervals_.begin();
  while (a != intervals_.end() && b != other.intervals_.end()) {
    const bool a_starts_later = a->lo > b->lo;
    const bool a_ends_first = a->hi < b->hi;
    const Interval overlap{a_starts_later ? a->lo : b->lo, a_ends_first ? a->hi : b->hi,
                           a_starts_later ? a->lo_tag : b->lo_tag,
                           a_ends_first ? a->hi_tag : b->hi_tag};
    if (overlap.lo < overlap.hi) both.intervals_.push_back(overlap);
    a_ends_first ? ++a : ++b;
  }
  return both;
}

IntervalSet IntervalSet::minus(const IntervalSet& removed) const {
  IntervalSet left;
  auto cut = removed.intervals_.begin();
  for (Interval rest : intervals_) {
    while (cut != removed.intervals_.end() && cut->hi <= rest.lo) ++cut;
    auto next = cut;
    while (next != removed.intervals_.end() && next->lo < rest.hi) {
      if (next->lo > rest.lo) {
        left.intervals_.push_back({rest.lo, next->lo, rest.lo_tag, next->lo_tag});
      }
      rest.lo = next->hi;
      rest.lo_tag = next->hi_tag;
      ++next;
    }
    if (rest.lo < rest.hi) left.intervals_.push_back(rest);
  }
  return left;
}

}  // namespace frustum
