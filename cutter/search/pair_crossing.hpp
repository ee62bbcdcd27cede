// Where a ray may cross the boxes of two groups.
//
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : as core/box.hpp: a crossing is never missed by rounding
#pragma once

#include "core/box.hpp"
#include "cutter/search/pose_group.hpp"

namespace frustum::cutter {

// lo above hi: nowhere.
struct PairSpan {
  Both lo{}, hi{};
};

class PairCrossing {
 public:
  explicit PairCrossing(const Ray& ray) : origin_(ray.origin) {
    for (int k = 0; k < 3; ++k) inverse_[k] = BoxCrossing::inverse_of(ray.direction[k]);
  }
  [[nodiscard]] PairSpan within(const GroupPair& groups, const RaySpan& span) const {
    PairSpan in{both(span.lo), both(span.hi)};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto d = static_cast<Eigen::Index>(k);
      const Both a = (both(groups.box_min[k]) - (origin_[d] + BoxCrossing::kMargin)) * inverse_[d];
      const Both b = (both(groups.box_max[k]) - (origin_[d] - BoxCrossing::kMargin)) * inverse_[d];
      in.lo = larger(in.lo, smaller(a, b));
      in.hi = smaller(in.hi, larger(a, b));
    }
    return in;
  }

 private:
  Vec3 origin_;
  Vec3 inverse_ = Vec3::Zero();
};

}  // namespace frustum::cutter
