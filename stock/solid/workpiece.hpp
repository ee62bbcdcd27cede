// The finished workpiece: exact along any ray. This is the truth; meshes are pictures of it.
//
// Model    : blank minus the union of all swept cutters
// Units    : mm; frame: workpiece
// Accuracy : 1 nm normal to the surface for the given ToolPath and convex cutters (concave ones:
//            cutter/sweep/concave_sweep.hpp); each point has its own bound. Rounding: a point is o
//            + s d, and its distance from a cutter is made of sums and products of coordinates, way
//            and reach, fewer than 32 on the longest path; each is off by half of 2.2e-16 of a
//            number below S = |o| + |s| + |tip| + reach, so that all together are below 32 *
//            2.2e-16 * S: 4e-12 mm at half a metre
// Threads  : const member functions may be called from any number of threads
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/interval_set.hpp"
#include "core/pose.hpp"
#include "core/provenance.hpp"
#include "core/ray.hpp"
#include "cutter/search/swept_cutter.hpp"
#include "stock/solid/blank.hpp"

namespace frustum::stock {

// A point of the workpiece surface, what made it, and how far it may be from the true surface,
// normal to it.
struct SurfacePoint {
  double s = 0.0;  // mm along the ray
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();             // unit, out of the material
  std::optional<std::uint32_t> segment{};  // of the tool path; nothing: the blank's own surface
  std::uint32_t source_line = 0;           // NC line that cut it; 0: the blank
  double t = 0.0;                          // when in the segment, 0..1
  double sweep_bound = 0.0;  // mm, from what this tool path leaves: solution and rounding
  double bound = 0.0;  // mm, from what the commanded motion leaves: the path's own bound added

  [[nodiscard]] Provenance provenance() const {
    return {segment, source_line, t, sweep_bound, bound};
  }
};

class Workpiece {
 public:
  Workpiece(Blank blank, cutter::SweptCutter removed);

  // Material met by the ray between span.lo and span.hi; ends carry tags for surface_at().
  [[nodiscard]] IntervalSet material_along(const Ray& ray, RaySpan span) const;
  // As above, but only the sweeps of segments before `first_excluded_segment` have been removed.
  [[nodiscard]] IntervalSet material_along(const Ray& ray, RaySpan span,
                                           std::uint32_t first_excluded_segment) const;
  // The same of parallel rays, bit for bit: in rows of `row`, neighbours near each other, so that
  // they share their search.
  [[nodiscard]] std::vector<IntervalSet> material_along_all(
      std::span<const Ray> rays, std::size_t row, RaySpan span,
      std::uint32_t first_excluded_segment = cutter::SweptCutter::kAll) const;
  // The surface at an interval end: s and tag as found in material_along() of the same ray.
  [[nodiscard]] SurfacePoint surface_at(const Ray& ray, double s, EndTag tag) const;
  // Where the ray first enters material after span.lo; nothing when it starts inside or meets none.
  [[nodiscard]] std::optional<SurfacePoint> first_surface(
      const Ray& ray, RaySpan span,
      std::uint32_t first_excluded_segment = cutter::SweptCutter::kAll) const;

  // The same, begun with what is likely to have made it.
  [[nodiscard]] std::optional<SurfacePoint> first_surface(
      const Ray& ray, RaySpan span, const cutter::SweptCutter::Likely& likely,
      std::uint32_t first_excluded_segment = cutter::SweptCutter::kAll) const;

  // What may have cut within `radius` of `centre`; `within`: of a ball around this one.
  [[nodiscard]] cutter::SweptNear near(const Vec3& centre, double radius,
                                       const cutter::SweptNear* within = nullptr) const {
    return removed_.near(centre, radius, cutter::SweptCutter::kAll, within);
  }

  [[nodiscard]] const Blank& blank() const { return blank_; }
  [[nodiscard]] const cutter::SweptCutter& removed() const { return removed_; }

 private:
  [[nodiscard]] SurfacePoint surface_point(const Ray& ray,
                                           const cutter::SweepContact& contact) const;

  Blank blank_;
  cutter::SweptCutter removed_;
};

}  // namespace frustum::stock
