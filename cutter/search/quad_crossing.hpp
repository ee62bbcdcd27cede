// Where a ray may cross the boxes of four groups.
//
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : as core/box.hpp: a crossing is never missed by rounding
#pragma once

#include "core/ray.hpp"
#include "cutter/search/pose_group.hpp"

namespace frustum::cutter {

// lo above hi: nowhere.
struct QuadSpan {
  DoubleFour lo, hi;
};

class QuadCrossing {
 public:
  explicit QuadCrossing(const Ray& ray);
  [[nodiscard]] QuadSpan within(const GroupQuad& groups, const RaySpan& span,
                                LaneChoice lanes = LaneChoice::best) const;

 private:
  Vec3 origin_;
  Vec3 inverse_ = Vec3::Zero();
};

}  // namespace frustum::cutter
