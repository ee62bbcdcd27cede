// Solids in closed form for the tests of the surface extraction: convex bodies, added and taken
// away in order.
// Units: mm, rad.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "core/interval_set.hpp"
#include "core/pose.hpp"
#include "stock/dexel/tri_dexel_solid.hpp"

namespace frustum::stock::testing {

struct BallBody {
  double radius = 1.0;
};
// Centred on the origin of its frame.
struct BoxBody {
  Vec3 half = Vec3::Ones();
};
// About the Z axis of its frame, centred.
struct CylinderBody {
  double radius = 1.0;
  double half_height = 1.0;
};

struct Body {
  std::variant<BallBody, BoxBody, CylinderBody> shape;
  Pose world_from_body{};
  bool removes = false;
};

using Chord = std::optional<std::pair<double, double>>;

// Where |p + s d| <= radius, in as many dimensions as the vectors have.
template <typename V>
Chord round_chord(const V& p, const V& d, double radius) {
  const double a = d.squaredNorm();
  const double along = p.dot(d);
  if (a < 1e-18) {
    if (p.norm() >= radius) return std::nullopt;
    return std::pair(-1e9, 1e9);
  }
  const V nearest = p - (along / a) * d;
  const double under = radius * radius - nearest.squaredNorm();
  if (under <= 0.0) return std::nullopt;
  const double half = std::sqrt(under / a);
  return std::pair(-along / a - half, -along / a + half);
}

inline Chord slab_chord(double p, double d, double half) {
  if (std::abs(d) < 1e-12) {
    if (std::abs(p) >= half) return std::nullopt;
    return std::pair(-1e9, 1e9);
  }
  return std::pair(std::min((-half - p) / d, (half - p) / d),
                   std::max((-half - p) / d, (half - p) / d));
}

inline Chord both(const Chord& a, const Chord& b) {
  if (!a || !b) return std::nullopt;
  const std::pair chord(std::max(a->first, b->first), std::min(a->second, b->second));
  if (chord.first >= chord.second) return std::nullopt;
  return chord;
}

inline Chord chord_of(const BallBody& ball, const Vec3& p, const Vec3& d) {
  return round_chord(p, d, ball.radius);
}
inline Chord chord_of(const BoxBody& box, const Vec3& p, const Vec3& d) {
  Chord chord = slab_chord(p[0], d[0], box.half[0]);
  chord = both(chord, slab_chord(p[1], d[1], box.half[1]));
  return both(chord, slab_chord(p[2], d[2], box.half[2]));
}
inline Chord chord_of(const CylinderBody& cylinder, const Vec3& p, const Vec3& d) {
  const Eigen::Vector2d p2 = p.head<2>();
  const Eigen::Vector2d d2 = d.head<2>();
  return both(round_chord(p2, d2, cylinder.radius), slab_chord(p[2], d[2], cylinder.half_height));
}

inline Vec3 normal_of(const BallBody& /*ball*/, const Vec3& p) { return p.normalized(); }
inline Vec3 normal_of(const BoxBody& box, const Vec3& p) {
  Eigen::Index axis = 0;
  (p.cwiseAbs() - box.half).maxCoeff(&axis);
  return std::copysign(1.0, p[axis]) * Vec3::Unit(axis);
}
inline Vec3 normal_of(const CylinderBody& cylinder, const Vec3& p) {
  const double across = std::hypot(p.x(), p.y());
  if (std::abs(p.z()) - cylinder.half_height > across - cylinder.radius) {
    return std::copysign(1.0, p.z()) * Vec3::UnitZ();
  }
  return Vec3(p.x(), p.y(), 0.0) / across;
}

struct Solid {
  std::vector<Body> bodies{};

  [[nodiscard]] IntervalSet material_along(const Ray& ray, RaySpan span) const {
    IntervalSet material;
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      const Pose body_from_world = bodies[b].world_from_body.inverse();
      const Vec3 p = body_from_world.point(ray.origin);
      const Vec3 d = body_from_world.direction(ray.direction);
      const Chord chord =
          std::visit([&](const auto& shape) { return chord_of(shape, p, d); }, bodies[b].shape);
      if (!chord) continue;
      const auto tag = static_cast<EndTag>(b);
      const IntervalSet covered({Interval{chord->first, chord->second, tag, tag}});
      material = bodies[b].removes ? material.minus(covered) : material.united(covered);
    }
    return material.intersected(IntervalSet({Interval{span.lo, span.hi, -1, -1}}));
  }

  [[nodiscard]] SurfacePoint surface_at(const Ray& ray, double s, EndTag tag) const {
    const Body& body = bodies[static_cast<std::size_t>(tag)];
    const Vec3 point = ray.at(s);
    const Vec3 p = body.world_from_body.inverse().point(point);
    const Vec3 normal = body.world_from_body.direction(
        std::visit([&](const auto& shape) { return normal_of(shape, p); }, body.shape));
    return {.s = s, .point = point, .normal = body.removes ? Vec3(-normal) : normal};
  }
};

inline BoundingBox box_around(const Vec3& centre, double half) {
  return {centre - Vec3::Constant(half), centre + Vec3::Constant(half)};
}

}  // namespace frustum::stock::testing
