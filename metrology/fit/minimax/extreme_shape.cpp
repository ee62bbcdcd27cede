#include "metrology/fit/minimax/extreme_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace frustum::metrology {
namespace {

using namespace surface_parameter;

const std::vector<ExtremeKind>& kinds() {
  static const std::vector<ExtremeKind> all{
      {.name = "line2d", .surface = Surface::plane, .free = {kTiltX, kRadius}},
      {.name = "line", .free = {kX, kY, kTiltX, kTiltY}, .has_sides = false},
      {.name = "plane", .surface = Surface::plane, .free = {kTiltX, kTiltY, kRadius}},
      {.name = "circle2d", .free = {kX, kY, kRadius}, .has_size = true},
      {.name = "circle", .free = {kX, kY, kRadius}, .has_size = true},
      {.name = "sphere",
       .surface = Surface::sphere,
       .free = {kX, kY, kZ, kRadius},
       .has_size = true},
      {.name = "cylinder", .free = {kX, kY, kTiltX, kTiltY, kRadius}, .has_size = true},
      {.name = "cone", .free = {kX, kY, kTiltX, kTiltY, kRadius, kShape}},
      {.name = "torus",
       .surface = Surface::ring,
       .free = {kX, kY, kZ, kTiltX, kTiltY, kRadius, kShape}},
  };
  return all;
}

// Columns x, y, z with z exact and y as near to `across` as may be.
Mat3 turned(const Vec3& z, const Vec3& across) {
  const Vec3 beside = across - across.dot(z) * z;
  Mat3 frame;
  frame.col(2) = z;
  // Nearer than a millionth to z, `across` tells no direction beside it.
  frame.col(1) = beside.norm() > 1e-6 ? Vec3(beside.normalized()) : perpendicular_to(z);
  frame.col(0) = frame.col(1).cross(z);
  return frame;
}

struct Sizes {
  double radius = 0.0;
  double shape = 0.0;
};
Sizes sizes_of(const Element& element) {
  if (const auto* circle = std::get_if<Circle>(&element)) return {circle->radius, 0.0};
  if (const auto* sphere = std::get_if<Sphere>(&element)) return {sphere->radius, 0.0};
  if (const auto* cylinder = std::get_if<Cylinder>(&element)) return {cylinder->radius, 0.0};
  if (const auto* cone = std::get_if<Cone>(&element)) return {cone->radius, cone->half_angle};
  if (const auto* torus = std::get_if<Torus>(&element)) return {torus->tube_radius, torus->radius};
  return {};
}

// The same axis with its point nearest the origin of the local frame, where the points are.
Vec3 nearest_origin(const Vec3& point, const Vec3& axis) { return point - point.dot(axis) * axis; }

Element cone_at(const Vec3& point, Vec3 axis, double radius, double angle) {
  const double back = point.dot(axis);
  radius -= back * std::sin(angle);
  if (angle < 0.0) {  // the same cone, opening the other way
    angle = -angle;
    axis = -axis;
  }
  return Cone{point - point.dot(axis) * axis, unit(axis), radius, angle};
}

}  // namespace

const ExtremeKind* extreme_kind(std::string_view name) {
  const auto found = std::find_if(kinds().begin(), kinds().end(),
                                  [&](const ExtremeKind& kind) { return kind.name == name; });
  return found == kinds().end() ? nullptr : &*found;
}

PlacedElement placed(const ExtremeKind& kind, const Element& local, const Vec3& across) {
  PlacedElement out;
  out.local_from_frame.translation = point_of(local);
  if (const UnitVec3* axis = axis_of(local)) {
    const bool flat_line = kind.name == "line2d";
    out.local_from_frame.rotation =
        turned(flat_line ? axis->vec().cross(across).normalized() : axis->vec(), across);
  }
  const Sizes sizes = sizes_of(local);
  out.at[kRadius] = sizes.radius;
  out.at[kShape] = sizes.shape;
  return out;
}

Element element_at(const ExtremeKind& kind, const PlacedElement& placed) {
  const Pose& frame = placed.local_from_frame;
  const Vec3 point = frame.point(placed.at.head<3>());
  const Vec3 axis = frame.direction(axis_direction(placed.at)).normalized();
  const double radius = placed.at[kRadius];
  if (kind.name == "plane") return Plane{(point.dot(axis) + radius) * axis, canonical(axis)};
  if (kind.name == "line2d") {
    const Vec3 along = frame.rotation.col(1).cross(axis).normalized();
    return Line{nearest_origin(point + radius * axis, along), canonical(along)};
  }
  if (kind.name == "line") return Line{nearest_origin(point, axis), canonical(axis)};
  if (kind.name == "sphere") return Sphere{point, radius};
  if (kind.name == "cylinder") {
    return Cylinder{nearest_origin(point, axis), canonical(axis), radius};
  }
  if (kind.name == "cone") return cone_at(point, axis, radius, placed.at[kShape]);
  if (kind.name == "torus") return Torus{point, canonical(axis), placed.at[kShape], radius};
  return Circle{point, canonical(axis), radius};
}

Element to_local(const NormalisedPoints& local, const Element& element) {
  return std::visit(
      [&](auto e) -> Element {
        e.point = (e.point - local.centre) / local.scale;
        if constexpr (requires { e.radius; }) e.radius /= local.scale;
        if constexpr (requires { e.tube_radius; }) e.tube_radius /= local.scale;
        return e;
      },
      element);
}

}  // namespace frustum::metrology
