// A directed line with unit direction, and the segment of it that matters.
// Units: mm along the direction.
#pragma once

#include "core/pose.hpp"

namespace frustum {

struct Ray {
  Vec3 origin = Vec3::Zero();
  Vec3 direction = Vec3::UnitZ();  // unit

  [[nodiscard]] Vec3 at(double s) const { return origin + s * direction; }
};

struct RaySpan {
  double lo = 0.0;
  double hi = 0.0;
};

}  // namespace frustum
