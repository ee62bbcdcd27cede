// Boxes along the axes of the workpiece frame, and a ray against them.
//
// Units    : mm
// Errors   : none
// Accuracy : a crossing is never missed by rounding: boxes count as 1e-9 mm larger
#pragma once

#include <algorithm>
#include <cmath>

#include "core/pose.hpp"
#include "core/ray.hpp"

namespace frustum {

struct Box {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Zero();
};

[[nodiscard]] inline bool overlap(const Box& a, const Box& b) {
  return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}
[[nodiscard]] inline Box united(const Box& a, const Box& b) {
  return {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
}

class BoxCrossing {
 public:
  explicit BoxCrossing(const Ray& ray) : origin_(ray.origin) {
    for (int k = 0; k < 3; ++k) inverse_[k] = inverse_of(ray.direction[k]);
  }
  static constexpr double kMargin = 1e-9;  // mm, above rounding
  // A ray along a face is as good as one that crosses it very far away.
  [[nodiscard]] static double inverse_of(double direction) {
    constexpr double kAlong = 1e-200;
    return std::abs(direction) < kAlong ? 1.0 / kAlong : 1.0 / direction;
  }
  // Where within the span the ray may cross the box; lo above hi: nowhere.
  [[nodiscard]] RaySpan within(const Box& box, const RaySpan& span) const {
    double lo = span.lo, hi = span.hi;
    for (int k = 0; k < 3; ++k) {
      const double a = (box.min[k] - kMargin - origin_[k]) * inverse_[k];
      const double b = (box.max[k] + kMargin - origin_[k]) * inverse_[k];
      lo = std::max(lo, std::min(a, b));
      hi = std::min(hi, std::max(a, b));
    }
    return {lo, hi};
  }

 private:
  Vec3 origin_;
  Vec3 inverse_ = Vec3::Zero();
};

}  // namespace frustum
