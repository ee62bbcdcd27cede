// Sets of disjoint closed intervals on a line, sorted; each end remembers what made it.
//
// Invariant: lo < hi, and every interval ends before the next begins: those that touch are
// joined.
// Units: whatever the caller measures along the line (mm along a ray).
// Errors: none; intervals that are empty or not numbers are dropped.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace frustum {

// Names what made an interval's end: what it means is up to the producer. Negative: nobody.
using EndTag = std::int64_t;

struct Interval {
  double lo = 0.0;
  double hi = 0.0;
  EndTag lo_tag = -1;
  EndTag hi_tag = -1;

  [[nodiscard]] double length() const { return hi - lo; }
  bool operator==(const Interval&) const = default;
};

class IntervalSet {
 public:
  IntervalSet() = default;
  // The union of `intervals`, given in any order and overlapping as they like.
  explicit IntervalSet(std::vector<Interval> intervals);

  [[nodiscard]] std::span<const Interval> intervals() const { return intervals_; }
  [[nodiscard]] bool empty() const { return intervals_.empty(); }
  [[nodiscard]] double length() const;
  [[nodiscard]] bool contains(double s) const;
  // True when [lo, hi] is inside one interval.
  [[nodiscard]] bool covers(double lo, double hi) const;

  [[nodiscard]] IntervalSet united(const IntervalSet& other) const;
  [[nodiscard]] IntervalSet intersected(const IntervalSet& other) const;
  // An end that `removed` creates has the tag of the removed interval's end.
  [[nodiscard]] IntervalSet minus(const IntervalSet& removed) const;

 private:
  std::vector<Interval> intervals_;
};

}  // namespace frustum
