// The surface at a measured point, asked from the workpiece again: the judge of what a probe's
// answer says.
// Units: mm; frame: workpiece
#pragma once

#include <optional>

#include "stock/solid/workpiece.hpp"

namespace frustum::trials {

// How far from the point surface_at_point() looks, to either side, mm.
inline constexpr double kSurfaceSearch = 0.05;

// Asked along the normal; nothing when there is no surface within reach.
[[nodiscard]] inline std::optional<stock::SurfacePoint> surface_at_point(
    const stock::Workpiece& workpiece, const Vec3& point, const Vec3& normal) {
  return workpiece.first_surface({point + kSurfaceSearch * normal, -normal},
                                 {0.0, 2.0 * kSurfaceSearch});
}

}  // namespace frustum::trials
