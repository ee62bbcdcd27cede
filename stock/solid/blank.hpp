// The body the machine starts from: box, cylinder, cone frustum, a loft of rectangles, or a mesh.
//
// Placed in the workpiece frame by `origin`, the centre of its bottom face (of a loft: of its z =
// 0; of a mesh: its own zero); its height runs along +Z.
// Units: mm. Errors: Blank::make refuses empty and non-finite bodies, and lofts that are no body.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/box.hpp"
#include "core/interval_set.hpp"
#include "core/pose.hpp"
#include "core/ray.hpp"
#include "core/result.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::stock {

struct BoxShape {
  double size_x = 0.0, size_y = 0.0, height = 0.0;
};
// bottom_radius == top_radius is a cylinder.
struct FrustumShape {
  double bottom_radius = 0.0, top_radius = 0.0, height = 0.0;
};
// A rectangle across Z, centred on the axis of the blank.
struct LoftSection {
  double z = 0.0;
  double size_x = 0.0, size_y = 0.0;
  bool operator==(const LoftSection&) const = default;
};
// Sections from bottom to top with flat faces between successive ones; two at one z make a ledge.
struct LoftShape {
  std::vector<LoftSection> sections{};
};
// One body bounded by facets (stock/polyhedral/mesh_faults.hpp tells whether they do).
struct MeshShape {
  std::shared_ptr<const FacetSolid> solid{};  // shared: a blank is copied
  std::string file{};                         // where it came from, as people write it
};
using BlankShape = std::variant<BoxShape, FrustumShape, LoftShape, MeshShape>;

// The convex body between two sections of a loft.
struct LoftSlab {
  LoftSection bottom{}, top{};
};
[[nodiscard]] std::vector<LoftSlab> slabs_of(const LoftShape& shape);

using BoundingBox = Box;

class Blank {
 public:
  [[nodiscard]] static Result<Blank> make(const BlankShape& shape, const Vec3& origin);

  // One interval at most, but of a loft several; ends are tagged with the index of the face.
  [[nodiscard]] IntervalSet along(const Ray& ray, RaySpan span) const;
  // Outward unit normal of the face with that tag at a point on it.
  [[nodiscard]] Vec3 normal(EndTag face, const Vec3& point) const;
  [[nodiscard]] BoundingBox bounds() const;
  [[nodiscard]] double volume() const;
  [[nodiscard]] const BlankShape& shape() const { return shape_; }
  [[nodiscard]] const Vec3& origin() const { return origin_; }

 private:
  Blank(const BlankShape& shape, const Vec3& origin);

  BlankShape shape_;
  Vec3 origin_;
  std::vector<LoftSlab> slabs_{};  // of a loft; asked for every ray
};

}  // namespace frustum::stock
