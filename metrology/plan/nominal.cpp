#include "metrology/plan/nominal.hpp"

#include <cmath>

#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {
namespace {

// A surface nearer than this in angle and distance is meant: machining errors are far smaller, the
// feature next to it is usually steeper.
const double kSameDirection = std::cos(20.0 * kRadPerDeg);
constexpr double kNear = 1.0;  // mm
// A face reaches its edges wherever machining errors have moved them.
constexpr double kEdge = 0.05;  // mm

// Is `away` no farther along a side of a rectangle than half of it?
bool within(const Vec3& away, const Vec3& side) {
  const double length = side.norm();
  return std::abs(away.dot(side)) <= (0.5 * length + kEdge) * length;
}

bool inside_plane_extent(const PlannedFeature& feature, const Vec3& point) {
  const Vec3 w = point - feature.point;
  if (const auto* r = std::get_if<RadialExtent>(&feature.extent)) {
    const double away = w.cross(unit(feature.axis).vec()).norm();
    return away >= r->inner - kEdge && away <= r->outer + kEdge;
  }
  if (const auto* r = std::get_if<RectangleExtent>(&feature.extent)) {
    return within(w, r->u) && within(w, r->v);
  }
  return true;  // not stated: the whole plane
}

bool owns(const PlannedFeature& feature, const Vec3& point) {
  switch (feature.kind) {
    case FeatureKind::plane:
      return inside_plane_extent(feature, point);
    case FeatureKind::cylinder:
    case FeatureKind::cone: {
      const AxialExtent extent = axial_extent(feature);
      const double along = (point - feature.point).dot(unit(feature.axis).vec());
      return along >= extent.from - kEdge && along <= extent.to + kEdge;
    }
    case FeatureKind::sphere:
      return true;
    case FeatureKind::ruled: {
      const SplineFoot foot = feature.net.surface->nearest(point);
      return foot.u >= 0.0 && foot.u <= 1.0 && foot.v >= 0.0 && foot.v <= 1.0;
    }
    case FeatureKind::circle:
    case FeatureKind::line:
    case FeatureKind::point:
      break;
  }
  return false;  // curves and points own no surface
}

// Of what has an element, that; a line is none of surfaces.
NominalSurface nominal_surface(const PlannedFeature& feature) {
  if (feature.kind == FeatureKind::ruled) return PlacedNet{feature.net.surface, {}};
  return nominal_element(feature);
}

}  // namespace

Element nominal_element(const PlannedFeature& feature) {
  const UnitVec3 axis = unit(feature.axis);
  switch (feature.kind) {
    case FeatureKind::plane:
    case FeatureKind::point:
      return Plane{feature.point, axis};
    case FeatureKind::cylinder:
      return Cylinder{feature.point, axis, feature.radius};
    case FeatureKind::cone:
      return Cone{feature.point, axis, feature.radius * std::cos(feature.half_angle),
                  feature.half_angle};
    case FeatureKind::circle:
      return Circle{feature.point, axis, feature.radius};
    case FeatureKind::sphere:
      return Sphere{feature.point, feature.radius};
    case FeatureKind::line:
    case FeatureKind::ruled:
      break;
  }
  return Line{feature.point, axis};
}

double material_sign(const PlannedFeature& feature) {
  return is_round(feature.kind) && feature.side == Side::inside ? -1.0 : 1.0;
}

std::optional<double> deviation_from_nominal(const InspectionPlan& plan, const Vec3& point,
                                             const Vec3& normal) {
  std::optional<double> best;
  for (const PlannedFeature& feature : plan.features) {
    if (!owns(feature, point)) continue;
    const double sign = material_sign(feature);
    const NominalFoot foot = nearest(nominal_surface(feature), point);
    const double deviation = sign * foot.distance;
    if (std::abs(deviation) >= kNear) continue;
    if (sign * foot.normal.dot(normal) < kSameDirection) continue;
    if (!best || std::abs(deviation) < std::abs(*best)) best = deviation;
  }
  return best;
}

NominalSurface planned_surface(const PlannedFeature& planned) {
  if (planned.kind != FeatureKind::line) return nominal_surface(planned);
  const Vec3 axis = unit(planned.axis);
  return Plane{planned.point, unit(planned.normal - planned.normal.dot(axis) * axis)};
}

}  // namespace frustum::metrology
