// Anything that answers an approach with a contact: a workpiece, a mesh, an analytic body.
//
// Units  : mm; one frame for starts, directions and answers
// Errors : nothing is returned when no surface is on the way or when the start is inside material
#pragma once

#include <concepts>
#include <optional>

#include "core/pose.hpp"
#include "metrology/touch.hpp"

namespace frustum::metrology {

// First surface point on the segment from `start` along `direction`, `length_mm` long.
template <typename T>
concept SurfaceProbe = requires(const T& body, const Vec3& start, const UnitVec3& direction,
                                double length_mm) {
  { body.touch(start, direction, length_mm) } -> std::same_as<std::optional<Touch>>;
};

// A view of any SurfaceProbe; does not own it. Keeps the machine that measures compiled once.
class SurfaceProbeRef {
 public:
  template <typename T>
  requires(SurfaceProbe<T> && !std::same_as<T, SurfaceProbeRef>)
      SurfaceProbeRef(const T& body)  // NOLINT: implicit, like a reference
      : body_(&body),
        touch_([](const void* who, const Vec3& start, const UnitVec3& direction, double length_mm) {
          return static_cast<const T*>(who)->touch(start, direction, length_mm);
        }) {}

  [[nodiscard]] std::optional<Touch> touch(const Vec3& start, const UnitVec3& direction,
                                           double length_mm) const {
    return touch_(body_, start, direction, length_mm);
  }

 private:
  const void* body_;
  std::optional<Touch> (*touch_)(const void*, const Vec3&, const UnitVec3&, double);
};

}  // namespace frustum::metrology
