// A solid as the surface extraction sees it: whatever answers along rays.
//
// material_along(ray, span) gives the intervals of the ray inside the material, clipped to the
// span. An end's tag is the solid's own business, but -1 is reserved for the ends of the span.
// surface_at(ray, s, tag) gives the point and the outward unit normal at such an end (never asked
// for tag -1). A solid that finds the first surface on a ray faster than by all of its intervals
// says so with first_surface(ray, span). All must be const, pure and callable from several threads.
// Units: mm. Errors: none.
#pragma once

#include <concepts>
#include <optional>
#include <span>
#include <vector>

#include "core/interval_set.hpp"
#include "core/ray.hpp"
#include "stock/solid/workpiece.hpp"

namespace frustum::stock {

template <typename S>
concept RaySolid = requires(const S& solid, const Ray& ray, RaySpan span, double s, EndTag tag) {
  { solid.material_along(ray, span) } -> std::convertible_to<IntervalSet>;
  { solid.surface_at(ray, s, tag) } -> std::convertible_to<SurfacePoint>;
};

// Where the ray first enters material after span.lo; nothing when it starts inside or meets none.
template <RaySolid S>
std::optional<SurfacePoint> first_surface_of(const S& solid, const Ray& ray, RaySpan span) {
  if constexpr (requires { solid.first_surface(ray, span); }) {
    return solid.first_surface(ray, span);
  } else {
    const IntervalSet material = solid.material_along(ray, span);
    if (material.empty() || material.intervals().front().lo_tag == -1) return std::nullopt;
    const Interval& first = material.intervals().front();
    return solid.surface_at(ray, first.lo, first.lo_tag);
  }
}

// The same, begun with what is likely to have made it, where the solid can make use of that.
template <RaySolid S>
std::optional<SurfacePoint> first_surface_of(const S& solid, const Ray& ray, RaySpan span,
                                             const cutter::SweptCutter::Likely& likely) {
  if constexpr (requires { solid.first_surface(ray, span, likely); }) {
    return solid.first_surface(ray, span, likely);
  } else {
    return first_surface_of(solid, ray, span);
  }
}

// What may have cut in a ball; nothing where the solid does not know.
template <RaySolid S>
std::optional<cutter::SweptNear> near_of(const S& solid, const Vec3& centre, double radius,
                                         const cutter::SweptNear* within) {
  if constexpr (requires { solid.near(centre, radius, within); }) {
    return solid.near(centre, radius, within);
  } else {
    return std::nullopt;
  }
}

// The material along parallel rays, in rows of `row`: shared work, where the solid offers that.
template <RaySolid S>
std::vector<IntervalSet> material_of_all(const S& solid, std::span<const Ray> rays, std::size_t row,
                                         RaySpan span) {
  if constexpr (requires { solid.material_along_all(rays, row, span); }) {
    return solid.material_along_all(rays, row, span);
  } else {
    std::vector<IntervalSet> all;
    all.reserve(rays.size());
    for (const Ray& ray : rays) all.push_back(solid.material_along(ray, span));
    return all;
  }
}

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
        all_([](const void* self, std::span<const Ray> rays, std::size_t row, RaySpan span) {
          return material_of_all(*static_cast<const S*>(self), rays, row, span);
        }),
        surface_([](const void* self, const Ray& ray, double s, EndTag tag) -> SurfacePoint {
          return static_cast<const S*>(self)->surface_at(ray, s, tag);
        }),
        first_([](const void* self, const Ray& ray, RaySpan span,
                  const cutter::SweptCutter::Likely& likely) {
          return first_surface_of(*static_cast<const S*>(self), ray, span, likely);
        }),
        near_([](const void* self, const Vec3& centre, double radius,
                 const cutter::SweptNear* within) {
          return near_of(*static_cast<const S*>(self), centre, radius, within);
        }) {}

  [[nodiscard]] IntervalSet material_along(const Ray& ray, RaySpan span) const {
    return along_(solid_, ray, span);
  }
  // Of parallel rays, in rows of `row`, neighbours near each other.
  [[nodiscard]] std::vector<IntervalSet> material_along_all(std::span<const Ray> rays,
                                                            std::size_t row, RaySpan span) const {
    return all_(solid_, rays, row, span);
  }
  [[nodiscard]] SurfacePoint surface_at(const Ray& ray, double s, EndTag tag) const {
    return surface_(solid_, ray, s, tag);
  }
  [[nodiscard]] std::optional<SurfacePoint> first_surface(
      const Ray& ray, RaySpan span, const cutter::SweptCutter::Likely& likely = {}) const {
    return first_(solid_, ray, span, likely);
  }
  [[nodiscard]] std::optional<cutter::SweptNear> near(
      const Vec3& centre, double radius, const cutter::SweptNear* within = nullptr) const {
    return near_(solid_, centre, radius, within);
  }

 private:
  const void* solid_;
  IntervalSet (*along_)(const void*, const Ray&, RaySpan);
  std::vector<IntervalSet> (*all_)(const void*, std::span<const Ray>, std::size_t, RaySpan);
  SurfacePoint (*surface_)(const void*, const Ray&, double, EndTag);
  std::optional<SurfacePoint> (*first_)(const void*, const Ray&, RaySpan,
                                        const cutter::SweptCutter::Likely&);
  std::optional<cutter::SweptNear> (*near_)(const void*, const Vec3&, double,
                                            const cutter::SweptNear*);
};

}  // namespace frustum::stock
