// The body the machine starts from: box, cylinder, or cone frustum.
//
// Placed in the workpiece frame by `origin`, the centre of its bottom face; its height runs along +Z.
// Units: mm. Errors: make_blank refuses empty and non-finite bodies.
#pragma once

#include <variant>

#include "core/interval_set.hpp"
#include "core/pose.hpp"
#include "core/result.hpp"
#include "cutter/ray.hpp"

namespace frustum::stock {

struct BoxShape {
  double size_x = 0.0, size_y = 0.0, height = 0.0;
};
// bottom_radius == top_radius is a cylinder.
struct FrustumShape {
  double bottom_radius = 0.0, top_radius = 0.0, height = 0.0;
};
using BlankShape = std::variant<BoxShape, FrustumShape>;

struct BoundingBox {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Zero();
};

class Blank {
 public:
  [[nodiscard]] static Result<Blank> make(const BlankShape& shape, const Vec3& origin);

  // At most one interval (all shapes are convex); ends are tagged with the index of the face.
  [[nodiscard]] IntervalSet along(const cutter::Ray& ray, cutter::RaySpan span) const;
  // Outward unit normal of the face with that tag at a point on it.
  [[nodiscard]] Vec3 normal(EndTag face, const Vec3& point) const;
  [[nodiscard]] BoundingBox bounds() const;
  [[nodiscard]] double volume() const;
  [[nodiscard]] const BlankShape& shape() const { return shape_; }
  [[nodiscard]] const Vec3& origin() const { return origin_; }

 private:
  Blank(const BlankShape& shape, const Vec3& origin) : shape_(shape), origin_(origin) {}
  BlankShape shape_;
  Vec3 origin_;
};

}  // namespace frustum::stock
