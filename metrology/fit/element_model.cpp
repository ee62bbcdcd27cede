#include "metrology/fit/element_model.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "metrology/fit/element_rows.hpp"

namespace frustum::metrology {
namespace {

using enum Parameter;
constexpr std::array kLine{shift_u, shift_v, tilt_u, tilt_v};
constexpr std::array kPlane{shift_along, tilt_u, tilt_v};
constexpr std::array kCircle{shift_u, shift_v, radius};
constexpr std::array kSphere{shift_x, shift_y, shift_z, radius};
constexpr std::array kCylinder{shift_u, shift_v, tilt_u, tilt_v, radius};
constexpr std::array kCone{shift_u, shift_v, tilt_u, tilt_v, radius, half_angle};
constexpr std::array kTorus{shift_u, shift_v, shift_along, tilt_u, tilt_v, radius, tube_radius};

// Of a step too long for the linear model of the angles.
double shortening(std::span<const Parameter> parameters, const ElementStep& step) {
  double tilt = 0.0;
  double opening = 0.0;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double by = step[static_cast<Eigen::Index>(i)];
    if (parameters[i] == tilt_u || parameters[i] == tilt_v) tilt = std::hypot(tilt, by);
    if (parameters[i] == half_angle) opening = std::abs(by);
  }
  return std::min(1.0, 0.3 / std::max(tilt, opening));
}

void keep_opening_toward_growth(Cone& cone) {
  if (cone.half_angle < 0.0) {
    cone.half_angle = -cone.half_angle;
    cone.axis = -cone.axis;
  }
  if (cone.half_angle > std::numbers::pi / 2.0) {  // past the plane
    cone.half_angle = std::numbers::pi - cone.half_angle;
    cone.axis = -cone.axis;
    cone.radius = -cone.radius;
  }
}

struct Move {
  Vec3 shift = Vec3::Zero();
  Vec3 tilt = Vec3::Zero();
  double radius = 0.0;
  double tube_radius = 0.0;
  double half_angle = 0.0;
};

Move move_of(const Element& element, const ElementStep& step) {
  const std::span<const Parameter> parameters = parameters_of(kind_of(element));
  assert(step.size() == static_cast<Eigen::Index>(parameters.size()));
  const double factor = shortening(parameters, step);
  const UnitVec3* axis = axis_of(element);
  const UnitVec3 a = axis != nullptr ? *axis : UnitVec3::z();
  const auto [u, v] = tangents(a);
  Move move;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double by = factor * step[static_cast<Eigen::Index>(i)];
    switch (parameters[i]) {
      case shift_u:
        move.shift += by * u;
        break;
      case shift_v:
        move.shift += by * v;
        break;
      case shift_along:
        move.shift += by * a.vec();
        break;
      case shift_x:
        move.shift.x() += by;
        break;
      case shift_y:
        move.shift.y() += by;
        break;
      case shift_z:
        move.shift.z() += by;
        break;
      case tilt_u:
        move.tilt += by * u;
        break;
      case tilt_v:
        move.tilt += by * v;
        break;
      case radius:
        move.radius += by;
        break;
      case tube_radius:
        move.tube_radius += by;
        break;
      case half_angle:
        move.half_angle += by;
        break;
    }
  }
  return move;
}

Vec3 shifted_on_axis(const Vec3& point, const UnitVec3& axis, const Vec3& to) {
  return point + (to - point).dot(axis.vec()) * axis.vec();
}

}  // namespace

std::span<const Parameter> parameters_of(ElementKind kind) {
  static constexpr std::array<std::span<const Parameter>, 7> kAll{
      kLine, kPlane, kCircle, kSphere, kCylinder, kCone, kTorus};
  return kAll.at(static_cast<std::size_t>(kind));
}

bool is_angle(Parameter parameter) {
  return parameter == tilt_u || parameter == tilt_v || parameter == half_angle;
}

LinearisedPoint linearised(const Element& element, const Vec3& point) {
  return std::visit(
      [&](const auto& e) {
        const auto one = row<double>(e, point.x(), point.y(), point.z());
        LinearisedPoint result{one.residual, ElementStep(one.gradient.size())};
        std::copy(one.gradient.begin(), one.gradient.end(), result.gradient.begin());
        return result;
      },
      element);
}

Element moved(const Element& element, const ElementStep& step) {
  const Move move = move_of(element, step);
  return std::visit(
      [&](auto e) -> Element {
        e.point += move.shift;
        if constexpr (requires { e.axis; }) e.axis = unit(e.axis.vec() + move.tilt);
        if constexpr (requires { e.radius; }) e.radius += move.radius;
        if constexpr (requires { e.tube_radius; }) e.tube_radius += move.tube_radius;
        if constexpr (requires { e.half_angle; }) {
          e.half_angle += move.half_angle;
          keep_opening_toward_growth(e);
        }
        return e;
      },
      element);
}

Element shifted(const Element& element, const Vec3& to) {
  Element result = element;
  if (auto* line = std::get_if<Line>(&result)) {
    line->point = shifted_on_axis(line->point, line->axis, to);
  } else if (auto* cylinder = std::get_if<Cylinder>(&result)) {
    cylinder->point = shifted_on_axis(cylinder->point, cylinder->axis, to);
  } else if (auto* cone = std::get_if<Cone>(&result)) {
    const double along = (to - cone->point).dot(cone->axis.vec());
    cone->point += along * cone->axis.vec();
    cone->radius += along * std::sin(cone->half_angle);
  } else if (auto* plane = std::get_if<Plane>(&result)) {
    plane->point = to - residual(*plane, to) * plane->axis.vec();
  }
  return result;
}

}  // namespace frustum::metrology
