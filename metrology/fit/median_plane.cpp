#include "metrology/fit/median_plane.hpp"

namespace frustum::metrology {

Plane median_plane(const Plane& first, const Plane& second) {
  const double sense = first.axis.vec().dot(second.axis.vec()) < 0.0 ? -1.0 : 1.0;
  const Vec3 sum = first.axis.vec() + sense * second.axis.vec();
  const double offset =
      (first.axis.vec().dot(first.point) + sense * second.axis.vec().dot(second.point)) /
      sum.norm();
  const UnitVec3 normal = unit(sum);
  const Vec3 middle = 0.5 * (first.point + second.point);
  return {middle + (offset - middle.dot(normal.vec())) * normal.vec(), normal};
}

}  // namespace frustum::metrology
