// Boxes along the axes of the workpiece frame, and a ray against them.
//
// Units    : mm
// Errors   : none
// Accuracy : a crossing is never missed by rounding: boxes count as 1e-9 mm larger
#pragma once

#include <algorithm>
#include <cmath>

#include "core/pose.hpp"
#include "cutter/ray.hpp"

namespace frustum::cutter {

struct Box {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Zero();
};

class BoxCrossing {
 public:
  explicit BoxCrossing(const Ray& ray) : origin_(ray.origin) {
    for (int k = 0; k < 3; ++k) inverse_[k] = 1.0 / ray.direction[k];
  }
  // Where within the span the ray may cross the box; lo above hi: nowhere.
  [[nodiscard]] RaySpan within(const Box& box, const RaySpan& span) const {
    double lo = span.lo, hi = span.hi;
    for (int k = 0; k < 3; ++k) {
      if (std::isinf(inverse_[k])) {
        if (origin_[k] < box.min[k] - kMargin || origin_[k] > box.max[k] + kMargin) {
          return {1.0, 0.0};
        }
        continue;
      }
      const double a = (box.min[k] - kMargin - origin_[k]) * inverse_[k];
      const double b = (box.max[k] + kMargin - origin_[k]) * inverse_[k];
      lo = std::max(lo, std::min(a, b));
      hi = std::min(hi, std::max(a, b));
    }
    return {lo, hi};
  }

 private:
  static constexpr double kMargin = 1e-9;  // mm, above rounding
  Vec3 origin_;
  Vec3 inverse_ = Vec3::Zero();
};

}  // namespace frustum::cutter
