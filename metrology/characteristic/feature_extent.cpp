#include "metrology/characteristic/feature_extent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "metrology/characteristic/round_profile.hpp"
#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {
namespace {

std::vector<Vec3> corners(const PlannedFeature& planned, const Vec3& u, const Vec3& v) {
  std::vector<Vec3> points;
  for (const double i : {-0.5, 0.5}) {
    for (const double j : {-0.5, 0.5}) points.emplace_back(planned.point + i * u + j * v);
  }
  return points;
}

std::vector<Vec3> across_disc(const PlannedFeature& planned, double radius, const Vec3& toward) {
  const Vec3 normal = unit(planned.axis);
  const auto within = UnitVec3::of(toward - toward.dot(normal) * normal);
  const Vec3 direction = within ? within->vec() : perpendicular_to(normal);
  return {planned.point - radius * direction, planned.point + radius * direction};
}

std::vector<Vec3> of_plane(const PlannedFeature& planned, const Vec3& toward) {
  if (const auto* e = std::get_if<RectangleExtent>(&planned.extent)) {
    return corners(planned, e->u, e->v);
  }
  if (const auto* e = std::get_if<RadialExtent>(&planned.extent)) {
    return across_disc(planned, e->outer, toward);
  }
  if (const auto* s = std::get_if<GridStrategy>(&planned.strategy)) {
    return corners(planned, s->u, s->v);
  }
  if (const auto* s = std::get_if<RingStrategy>(&planned.strategy); s && !s->rings.empty()) {
    return across_disc(planned, *std::max_element(s->rings.begin(), s->rings.end()), toward);
  }
  return {planned.point};
}

std::vector<Vec3> planned_extremes(const PlannedFeature& planned, const Vec3& toward) {
  switch (planned.kind) {
    case FeatureKind::plane:
      return of_plane(planned, toward);
    case FeatureKind::cylinder:
    case FeatureKind::cone:
    case FeatureKind::line: {
      const AxialExtent extent = axial_extent(planned);
      const Vec3 axis = unit(planned.axis);
      return {planned.point + extent.from * axis, planned.point + extent.to * axis};
    }
    case FeatureKind::circle:
    case FeatureKind::sphere:
    case FeatureKind::point:
    case FeatureKind::ruled:
      break;
  }
  return {planned.point};
}

Vec3 laid_onto(const Element& element, const Vec3& point) {
  const Vec3 w = point - point_of(element);
  if (std::holds_alternative<Plane>(element)) {
    const Vec3 normal = *axis_of(element);
    return point - w.dot(normal) * normal;
  }
  if (std::holds_alternative<Circle>(element) || axis_of(element) == nullptr) {
    return point_of(element);
  }
  const Vec3 axis = *axis_of(element);
  return point_of(element) + w.dot(axis) * axis;
}

}  // namespace

std::vector<Vec3> extremes(const PlannedFeature& planned, const Element& element,
                           const Vec3& toward) {
  std::vector<Vec3> points = planned_extremes(planned, toward);
  for (Vec3& p : points) p = laid_onto(element, p);
  return points;
}

std::vector<Vec3> outline(const PlannedFeature& planned, const Element& element) {
  constexpr int kDiameters = 36;  // 1 - cos(2.5 deg) of the radius is less than 0.1 %
  const auto [u, v] = tangents(unit(planned.axis));
  std::vector<Vec3> points = extremes(planned, element, u);
  const bool is_disc = planned.kind == FeatureKind::plane && points.size() == 2;
  for (int i = 1; is_disc && i < kDiameters; ++i) {
    const double angle = std::numbers::pi * i / kDiameters;
    for (const Vec3& p : extremes(planned, element, std::cos(angle) * u + std::sin(angle) * v)) {
      points.push_back(p);
    }
  }
  return points;
}

Result<MedianLine> median_line(const FittedFeature& feature) {
  std::set<std::size_t> sections;
  for (const MeasuredPoint& p : feature.points) sections.insert(p.section);
  if (sections.size() < 2) {
    return error(
        "too-few-points"_id,
        fmt::format("'{}' has one section, a median line needs two or more", feature.planned->name),
        "measure more sections, or take criterion = \"ls\"");
  }
  MedianLine line;
  for (const std::size_t section : sections) {
    const auto circle = section_circle(feature, section, *axis_of(feature.element));
    if (!circle) return circle.error();
    line.centres.push_back(circle->element.point);
    line.own.push_back(centre_variance(*circle));
  }
  return line;
}

}  // namespace frustum::metrology
