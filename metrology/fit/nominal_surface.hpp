// A planned surface of any kind: an element, or a net of B-splines laid somewhere.
//
// Model    : signed distance as of element.hpp; of a net along its normal
// Units    : mm, rad
// Shape    : one point a call
// Errors   : none
// Accuracy : that of element.hpp and spline_surface.hpp
// Source   : those
#pragma once

#include <memory>
#include <variant>

#include "core/spline_surface.hpp"
#include "metrology/fit/element.hpp"

namespace frustum::metrology {

struct PlacedNet {
  std::shared_ptr<const SplineSurface> surface{};  // not null
  Pose placed_from_surface{};
};
using NominalSurface = std::variant<Element, PlacedNet>;

// Distance and normal of the surface nearest to a point: the direction in which the distance grows.
struct NominalFoot {
  double distance = 0.0;
  Vec3 normal = Vec3::UnitZ();
};
[[nodiscard]] NominalFoot nearest(const NominalSurface& surface, const Vec3& point);
[[nodiscard]] double residual(const NominalSurface& surface, const Vec3& point);
[[nodiscard]] Vec3 outward_normal(const NominalSurface& surface, const Vec3& point);
[[nodiscard]] NominalSurface transformed(const Pose& to_from, const NominalSurface& surface);

}  // namespace frustum::metrology
