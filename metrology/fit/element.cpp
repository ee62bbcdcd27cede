#include "metrology/fit/element.hpp"

#include <cassert>
#include <cmath>
#include <limits>

namespace frustum::metrology {
namespace {

// Where a point stands to an axis: along it, away from it, and in which direction away.
struct AxialPlace {
  double along;
  double away;
  Vec3 outward;
};

AxialPlace place(const Vec3& point, const UnitVec3& axis, const Vec3& x) {
  const Vec3 w = x - point;
  const double along = w.dot(axis.vec());
  const Vec3 lateral = w - along * axis.vec();
  const double away = lateral.norm();
  // A point on the axis has no direction away from it: any one serves.
  const Vec3 outward =
      away > std::numeric_limits<double>::min() ? Vec3(lateral / away) : perpendicular_to(axis);
  return {along, away, outward};
}

Vec3 away_from(const Vec3& centre, const Vec3& x) {
  const auto direction = UnitVec3::of(x - centre);
  return direction ? direction->vec() : Vec3(Vec3::UnitZ());
}

template <typename... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <typename... F>
Overloaded(F...) -> Overloaded<F...>;

}  // namespace

double Cone::section_radius(double along) const {
  return radius / std::cos(half_angle) + along * std::tan(half_angle);
}

Vec3 Cone::apex() const { return point - (radius / std::sin(half_angle)) * axis.vec(); }

ElementKind kind_of(const Element& element) { return static_cast<ElementKind>(element.index()); }

std::string_view name_of(ElementKind kind) {
  return kElementNames.at(static_cast<std::size_t>(kind));
}

Element element_of(ElementKind kind) {
  static const std::array<Element, 7> kAll{Line{},     Plane{}, Circle{}, Sphere{},
                                           Cylinder{}, Cone{},  Torus{}};
  return kAll.at(static_cast<std::size_t>(kind));
}

double residual(const Line& line, const Vec3& point) {
  return place(line.point, line.axis, point).away;
}
double residual(const Plane& plane, const Vec3& point) {
  return (point - plane.point).dot(plane.axis.vec());
}
double residual(const Circle& circle, const Vec3& point) {
  return place(circle.point, circle.axis, point).away - circle.radius;
}
double residual(const Sphere& sphere, const Vec3& point) {
  return (point - sphere.point).norm() - sphere.radius;
}
double residual(const Cylinder& cylinder, const Vec3& point) {
  return place(cylinder.point, cylinder.axis, point).away - cylinder.radius;
}
double residual(const Cone& cone, const Vec3& point) {
  const AxialPlace at = place(cone.point, cone.axis, point);
  return at.away * std::cos(cone.half_angle) - at.along * std::sin(cone.half_angle) - cone.radius;
}
double residual(const Torus& torus, const Vec3& point) {
  const AxialPlace at = place(torus.point, torus.axis, point);
  return std::hypot(at.away - torus.radius, at.along) - torus.tube_radius;
}
double residual(const Element& element, const Vec3& point) {
  return std::visit([&](const auto& e) { return residual(e, point); }, element);
}

Vec3 outward_normal(const Element& element, const Vec3& point) {
  return std::visit(
      Overloaded{
          [](const Plane& e) -> Vec3 { return e.axis; },
          [&](const Sphere& e) -> Vec3 { return away_from(e.point, point); },
          [&](const Cone& e) -> Vec3 {
            return std::cos(e.half_angle) * place(e.point, e.axis, point).outward -
                   std::sin(e.half_angle) * e.axis.vec();
          },
          [&](const Torus& e) -> Vec3 {
            const AxialPlace at = place(e.point, e.axis, point);
            const Vec3 from_middle = (at.away - e.radius) * at.outward + at.along * e.axis.vec();
            return UnitVec3::of(from_middle).value_or(e.axis);
          },
          [&](const auto& e) -> Vec3 { return place(e.point, e.axis, point).outward; },
      },
      element);
}

Element offset(const Element& element, double distance) {
  return std::visit(Overloaded{
                        [](const Line& e) -> Element { return e; },
                        [&](const Plane& e) -> Element {
                          return Plane{e.point + distance * e.axis.vec(), e.axis};
                        },
                        [&](Torus e) -> Element {
                          e.tube_radius += distance;
                          return e;
                        },
                        [&](auto e) -> Element {
                          e.radius += distance;
                          return e;
                        },
                    },
                    element);
}

Element transformed(const Pose& to_from, const Element& element) {
  return std::visit(
      [&](auto e) -> Element {
        e.point = to_from.point(e.point);
        if constexpr (requires { e.axis; }) e.axis = unit(to_from.direction(e.axis));
        return e;
      },
      element);
}

const UnitVec3* axis_of(const Element& element) {
  return std::visit(
      [](const auto& e) -> const UnitVec3* {
        if constexpr (requires { e.axis; }) {
          return &e.axis;
        } else {
          return nullptr;
        }
      },
      element);
}

Vec3 point_of(const Element& element) {
  return std::visit([](const auto& e) { return e.point; }, element);
}

Element agreeing(Element element, const Vec3& direction) {
  std::visit(
      [&](auto& e) {
        if constexpr (requires { e.axis; }) {
          if (e.axis.vec().dot(direction) < 0.0) e.axis = -e.axis;
        }
      },
      element);
  return element;
}

std::pair<Vec3, Vec3> tangents(const UnitVec3& axis) {
  const Vec3 u = perpendicular_to(axis);
  return {u, axis.vec().cross(u)};
}

UnitVec3 unit(const Vec3& v) {
  const auto direction = UnitVec3::of(v);
  assert(direction.has_value());
  return direction.value_or(UnitVec3::z());
}

}  // namespace frustum::metrology
