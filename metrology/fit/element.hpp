// Ideal geometric elements: what a measured feature is compared with.
//
// Model    : signed distance of a point from the element; outside (away from the axis or centre, on
//            the side of a plane's axis) is positive; for a line the distance, never negative; for
//            a circle the distance in the plane of the circle, for a torus the distance from its
//            tube
// Units    : mm, rad
// Shape    : one point a call; values without allocation
// Errors   : none; where a direction is not defined (a point on the axis) any unit vector is
//            returned
// Accuracy : rounding of doubles
// Source   : definitions of ISO 17450-1; the cone as in the NIST reference pairs
#pragma once

#include <array>
#include <string_view>
#include <utility>
#include <variant>

#include "core/pose.hpp"

namespace frustum::metrology {

struct Line {
  Vec3 point = Vec3::Zero();
  UnitVec3 axis = UnitVec3::z();
};

struct Plane {
  Vec3 point = Vec3::Zero();
  UnitVec3 axis = UnitVec3::z();  // the normal
};

struct Circle {
  Vec3 point = Vec3::Zero();      // centre
  UnitVec3 axis = UnitVec3::z();  // normal of its plane
  double radius = 1.0;            // mm
};

struct Sphere {
  Vec3 point = Vec3::Zero();  // centre
  double radius = 1.0;        // mm
};

struct Cylinder {
  Vec3 point = Vec3::Zero();  // on the axis
  UnitVec3 axis = UnitVec3::z();
  double radius = 1.0;  // mm
};

struct Cone {
  Vec3 point = Vec3::Zero();      // on the axis, never the apex
  UnitVec3 axis = UnitVec3::z();  // toward growing radius
  double radius = 1.0;            // mm: orthogonal distance from `point` to the surface
  double half_angle = 0.25;       // rad, between axis and generatrix

  // Radius of the section perpendicular to the axis, `along` mm from `point`.
  [[nodiscard]] double section_radius(double along) const;
  [[nodiscard]] Vec3 apex() const;
};

struct Torus {
  Vec3 point = Vec3::Zero();      // centre
  UnitVec3 axis = UnitVec3::z();  // of revolution
  double radius = 1.0;            // mm, of the circle in the middle of the tube
  double tube_radius = 0.25;      // mm
};

using Element = std::variant<Line, Plane, Circle, Sphere, Cylinder, Cone, Torus>;

// Same order as the alternatives of Element.
enum class ElementKind { line, plane, circle, sphere, cylinder, cone, torus };
inline constexpr std::array<std::string_view, 7> kElementNames{
    "line", "plane", "circle", "sphere", "cylinder", "cone", "torus"};
[[nodiscard]] ElementKind kind_of(const Element& element);
[[nodiscard]] std::string_view name_of(ElementKind kind);
// The one of its defaults.
[[nodiscard]] Element element_of(ElementKind kind);

[[nodiscard]] double residual(const Line& line, const Vec3& point);
[[nodiscard]] double residual(const Plane& plane, const Vec3& point);
[[nodiscard]] double residual(const Circle& circle, const Vec3& point);
[[nodiscard]] double residual(const Sphere& sphere, const Vec3& point);
[[nodiscard]] double residual(const Cylinder& cylinder, const Vec3& point);
[[nodiscard]] double residual(const Cone& cone, const Vec3& point);
[[nodiscard]] double residual(const Torus& torus, const Vec3& point);
[[nodiscard]] double residual(const Element& element, const Vec3& point);

// Unit normal of the element nearest to `point`: the direction in which `residual` grows.
[[nodiscard]] Vec3 outward_normal(const Element& element, const Vec3& point);

// The parallel element, `distance` outward: cone and cylinder grow, so does the tube of a torus; a
// plane moves along its axis.
// Lines have no outside and stay.
[[nodiscard]] Element offset(const Element& element, double distance);

[[nodiscard]] Element transformed(const Pose& to_from, const Element& element);

// The direction that tells how the element lies: axis or normal; nothing for a sphere.
[[nodiscard]] const UnitVec3* axis_of(const Element& element);
[[nodiscard]] Vec3 point_of(const Element& element);

// The same element with its axis on the side of `direction`; a cone so turned would be another one.
[[nodiscard]] Element agreeing(Element element, const Vec3& direction);

// Two unit vectors that complete `axis` to a right-handed frame {u, v, axis}. Covariances of fits
// are given along them.
[[nodiscard]] std::pair<Vec3, Vec3> tangents(const UnitVec3& axis);

// `v` as a unit vector; `v` must have a length (an assertion, for directions known to be good).
[[nodiscard]] UnitVec3 unit(const Vec3& v);

}  // namespace frustum::metrology
