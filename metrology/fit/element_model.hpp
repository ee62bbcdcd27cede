// Elements as models that are moved by small steps of their own parameters: what fits by any
// criterion linearise.
//
// Model    : an element near e is moved(e, step); residual(moved(e, step), x) is
//            residual(e, x) + gradient . step + O(step^2)
// Units    : mm, rad
// Shape    : one point or one step a call, no allocation
// Errors   : none
// Accuracy : the gradient to rounding
// Source   : ours
#pragma once

#include <Eigen/Core>
#include <span>

#include "metrology/fit/element.hpp"

namespace frustum::metrology {

// Directions u, v are tangents(axis); a tilt turns the axis about the element's point toward u, v.
enum class Parameter {
  shift_u,
  shift_v,
  shift_along,  // the axis
  shift_x,
  shift_y,
  shift_z,
  tilt_u,
  tilt_v,
  radius,
  tube_radius,
  half_angle
};

// In the order of steps and gradients:
//   line     : shift_u, shift_v, tilt_u, tilt_v
//   plane    : shift_along, tilt_u, tilt_v
//   circle   : shift_u, shift_v, radius; its plane stays, as its residuals are in it
//   sphere   : shift_x, shift_y, shift_z, radius
//   cylinder : shift_u, shift_v, tilt_u, tilt_v, radius
//   cone     : shift_u, shift_v, tilt_u, tilt_v, radius, half_angle
//   torus    : shift_u, shift_v, shift_along, tilt_u, tilt_v, radius, tube_radius
[[nodiscard]] std::span<const Parameter> parameters_of(ElementKind kind);
[[nodiscard]] bool is_angle(Parameter parameter);

inline constexpr int kMostParameters = 7;
using ElementStep = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostParameters, 1>;

struct LinearisedPoint {
  double residual = 0.0;
  ElementStep gradient{};  // d residual / d parameter
};
[[nodiscard]] LinearisedPoint linearised(const Element& element, const Vec3& point);

// The whole step is shortened when it turns an angle by more than 0.3 rad, where the linear model
// means nothing. A cone whose half angle passes 0 or 90 deg is the same cone opening the other way.
[[nodiscard]] Element moved(const Element& element, const ElementStep& step);

// The same element with its point shifted along it (axis, plane) to where it is nearest `to`: there
// shifts and tilts hardly correlate. Circles, spheres and tori stay.
[[nodiscard]] Element shifted(const Element& element, const Vec3& to);

}  // namespace frustum::metrology
