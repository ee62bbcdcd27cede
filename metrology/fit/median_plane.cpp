#include "metrology/fit/median_plane.hpp"

#include <cmath>

namespace frustum::metrology {

double sense_between(const Vec3& first_normal, const Vec3& second_normal) {
  return first_normal.dot(second_normal) < 0.0 ? -1.0 : 1.0;
}

double sense_towards(const Vec3& first_normal, const Vec3& second_normal, const Vec3& direction,
                     bool along) {
  const auto alike = [&](double sense) {
    const Vec3 sum = first_normal + sense * second_normal;
    const double length = sum.norm();
    // Parallel faces have one median plane.
    if (length < 1e-6) return -1.0;
    const double cosine = std::abs(sum.dot(direction)) / length;
    return along ? 1.0 - cosine : cosine;
  };
  return alike(-1.0) > alike(1.0) ? -1.0 : 1.0;
}

Plane median_plane(const Plane& first, const Plane& second, double sense) {
  const Vec3 sum = first.axis.vec() + sense * second.axis.vec();
  const double offset =
      (first.axis.vec().dot(first.point) + sense * second.axis.vec().dot(second.point)) /
      sum.norm();
  const UnitVec3 normal = unit(sum);
  const Vec3 middle = 0.5 * (first.point + second.point);
  return {middle + (offset - middle.dot(normal.vec())) * normal.vec(), normal};
}

}  // namespace frustum::metrology
