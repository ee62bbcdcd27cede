// Residual of a point from an element with its derivatives by the element's local parameters, for
// one point or for a block of points at a time.
//
// Model  : residual() of element.hpp; the parameters and their order are those of element_model.hpp
// Units  : mm, rad
// Shape  : Real is double, or an Eigen array whose coefficients are points
// Errors : none; a point on the axis or in the centre, where the distance has no derivative, gets
//          zeros
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>

#include "metrology/fit/element.hpp"

namespace frustum::metrology {

template <typename E>
inline constexpr int kParametersOf = 0;
template <>
inline constexpr int kParametersOf<Line> = 4;
template <>
inline constexpr int kParametersOf<Plane> = 3;
template <>
inline constexpr int kParametersOf<Circle> = 3;
template <>
inline constexpr int kParametersOf<Sphere> = 4;
template <>
inline constexpr int kParametersOf<Cylinder> = 5;
template <>
inline constexpr int kParametersOf<Cone> = 6;
template <>
inline constexpr int kParametersOf<Torus> = 7;

template <typename Real, int N>
struct Row {
  Real residual;
  std::array<Real, static_cast<std::size_t>(N)> gradient;
};

namespace rows {

inline double at_least(double x, double least) { return std::max(x, least); }
template <typename Array>
auto at_least(const Array& x, double least) {
  return x.max(least);
}

constexpr double kNothing = std::numeric_limits<double>::min();

// Where points stand to an axis with tangents u, v.
template <typename Real>
struct Place {
  Real along;
  Real away;
  Real eu;  // direction away from the axis
  Real ev;
};

template <typename Real>
Real dot(const Vec3& a, const Real& x, const Real& y, const Real& z) {
  return a.x() * x + a.y() * y + a.z() * z;
}

template <typename Real>
Place<Real> place(const Vec3& point, const UnitVec3& axis, const Real& x, const Real& y,
                  const Real& z) {
  using std::sqrt;
  const auto [u, v] = tangents(axis);
  const Real wx = x - point.x();
  const Real wy = y - point.y();
  const Real wz = z - point.z();
  const Real pu = dot<Real>(u, wx, wy, wz);
  const Real pv = dot<Real>(v, wx, wy, wz);
  const Real away = sqrt(pu * pu + pv * pv);
  const Real inverse = 1.0 / at_least(away, kNothing);
  return {dot<Real>(axis, wx, wy, wz), away, pu * inverse, pv * inverse};
}

}  // namespace rows

template <typename Real>
Row<Real, 4> row(const Line& e, const Real& x, const Real& y, const Real& z) {
  const auto at = rows::place<Real>(e.point, e.axis, x, y, z);
  return {at.away, {-at.eu, -at.ev, -at.along * at.eu, -at.along * at.ev}};
}

template <typename Real>
Row<Real, 3> row(const Plane& e, const Real& x, const Real& y, const Real& z) {
  const auto [u, v] = tangents(e.axis);
  const Real wx = x - e.point.x();
  const Real wy = y - e.point.y();
  const Real wz = z - e.point.z();
  return {rows::dot<Real>(e.axis, wx, wy, wz),
          {0.0 * wx - 1.0, rows::dot<Real>(u, wx, wy, wz), rows::dot<Real>(v, wx, wy, wz)}};
}

template <typename Real>
Row<Real, 3> row(const Circle& e, const Real& x, const Real& y, const Real& z) {
  const auto at = rows::place<Real>(e.point, e.axis, x, y, z);
  return {at.away - e.radius, {-at.eu, -at.ev, 0.0 * at.eu - 1.0}};
}

template <typename Real>
Row<Real, 4> row(const Sphere& e, const Real& x, const Real& y, const Real& z) {
  using std::sqrt;
  const Real wx = x - e.point.x();
  const Real wy = y - e.point.y();
  const Real wz = z - e.point.z();
  const Real away = sqrt(wx * wx + wy * wy + wz * wz);
  const Real inverse = -1.0 / rows::at_least(away, rows::kNothing);
  return {away - e.radius, {wx * inverse, wy * inverse, wz * inverse, 0.0 * wx - 1.0}};
}

template <typename Real>
Row<Real, 5> row(const Cylinder& e, const Real& x, const Real& y, const Real& z) {
  const auto at = rows::place<Real>(e.point, e.axis, x, y, z);
  return {at.away - e.radius,
          {-at.eu, -at.ev, -at.along * at.eu, -at.along * at.ev, 0.0 * at.eu - 1.0}};
}

template <typename Real>
Row<Real, 6> row(const Cone& e, const Real& x, const Real& y, const Real& z) {
  const auto at = rows::place<Real>(e.point, e.axis, x, y, z);
  const double c = std::cos(e.half_angle);
  const double s = std::sin(e.half_angle);
  const Real slant = at.along * c + at.away * s;  // along the generatrix
  return {at.away * c - at.along * s - e.radius,
          {-c * at.eu, -c * at.ev, -slant * at.eu, -slant * at.ev, 0.0 * at.eu - 1.0, -slant}};
}

template <typename Real>
Row<Real, 7> row(const Torus& e, const Real& x, const Real& y, const Real& z) {
  using std::sqrt;
  const auto at = rows::place<Real>(e.point, e.axis, x, y, z);
  const Real beyond = at.away - e.radius;  // of the circle in the middle of the tube
  const Real from_middle = sqrt(beyond * beyond + at.along * at.along);
  const Real inverse = 1.0 / rows::at_least(from_middle, rows::kNothing);
  const Real across = beyond * inverse;
  const Real up = at.along * inverse;
  const Real lever = e.radius * up;
  return {from_middle - e.tube_radius,
          {-across * at.eu, -across * at.ev, -up, lever * at.eu, lever * at.ev, -across,
           0.0 * up - 1.0}};
}

}  // namespace frustum::metrology
