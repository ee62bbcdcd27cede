// A solid as the surface extraction sees it: whatever answers along rays.
//
// material_along(ray, span) gives the intervals of the ray inside the material, clipped to the
// span. An end's tag is the solid's own business, but -1 is reserved for the ends of the span.
// surface_at(ray, s, tag) gives the point and the outward unit normal at such an end (never asked
// for tag -1). Both must be const, pure and callable from several threads.
// Units: mm. Errors: none.
#pragma once

#include <concepts>

#include "core/interval_set.hpp"
#include "cutter/ray.hpp"
#include "stock/workpiece.hpp"

namespace frustum::stock {

template <typename S>
concept RaySolid = requires(const S& solid, const Ray& ray, RaySpan span, double s, EndTag tag) {
  { solid.material_along(ray, span) } -> std::convertible_to<IntervalSet>;
  { solid.surface_at(ray, s, tag) } -> std::convertible_to<SurfacePoint>;
};

// Refers to a RaySolid without owning it, so that the extraction is compiled once. The solid must
// outlive the view; a view as a function parameter is the intended use.
class SolidView {
 public:
  template <RaySolid S>
  requires(!std::same_as<S, SolidView>) SolidView(
      const S& solid)  // NOLINT(google-explicit-constructor): a view of it, as string_view
      : solid_(&solid),
        along_([](const void* self, const Ray& ray, RaySpan span) -> IntervalSet {
          return static_cast<const S*>(self)->material_along(ray, span);
        }),
        surface_([](const void* self, const Ray& ray, double s, EndTag tag) -> SurfacePoint {
          return static_cast<const S*>(self)->surface_at(ray, s, tag);
        }) {}

  [[nodiscard]] IntervalSet material_along(const Ray& ray, RaySpan span) const {
    return along_(solid_, ray, span);
  }
  [[nodiscard]] SurfacePoint surface_at(const Ray& ray, double s, EndTag tag) const {
    return surface_(solid_, ray, s, tag);
  }

 private:
  const void* solid_;
  IntervalSet (*along_)(const void*, const Ray&, RaySpan);
  SurfacePoint (*surface_)(const void*, const Ray&, double, EndTag);
};

}  // namespace frustum::stock
