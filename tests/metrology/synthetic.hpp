// Points on known elements in random places, for tests of the fits.
// Units: mm, rad.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.hpp"
#include "metrology/fit/element.hpp"

namespace frustum::metrology::synthetic {

// A stream of repeatable numbers for one test.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : key_{.seed = seed} {}
  double between(double low, double high) { return low + (high - low) * uniform(key_, index_++); }
  double gauss() { return normal(key_, index_++); }
  UnitVec3 direction() { return unit(Vec3(gauss(), gauss(), gauss())); }
  Vec3 place(double size) {
    return {between(-size, size), between(-size, size), between(-size, size)};
  }
  Pose pose(double size) {
    const UnitVec3 axis = direction();
    return {rotation_about(axis, between(-3.0, 3.0)), place(size)};
  }

 private:
  RandomKey key_;
  std::uint64_t index_ = 0;
};

// Points on a surface of revolution about `axis` through `point`: `rings` circles over `length`
// from `from`, over `arc` rad, with radius(along).
template <typename Radius>
std::vector<Vec3> revolution(const Vec3& point, const UnitVec3& axis, double from, double length,
                             int rings, int per_ring, double arc, double start, Radius radius) {
  const auto [u, v] = tangents(axis);
  std::vector<Vec3> points;
  for (int i = 0; i < rings; ++i) {
    const double along = from + length * i / std::max(rings - 1, 1);
    for (int j = 0; j < per_ring; ++j) {
      const double turn = start + arc * j / per_ring;
      points.emplace_back(point + along * axis.vec() +
                          radius(along) * (std::cos(turn) * u + std::sin(turn) * v));
    }
  }
  return points;
}

// Distance of `x` from the axis through `point`.
inline double off_axis(const Vec3& point, const UnitVec3& axis, const Vec3& x) {
  return (x - point).cross(axis.vec()).norm();
}

// Angle between lines: the sense of the axes does not count.
inline double line_angle(const UnitVec3& a, const UnitVec3& b) {
  return std::asin(std::min(1.0, a.vec().cross(b.vec()).norm()));
}

}  // namespace frustum::metrology::synthetic
