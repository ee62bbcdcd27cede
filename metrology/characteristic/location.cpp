// Position, coaxiality, concentricity and symmetry.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "metrology/characteristic/datum_element.hpp"
#include "metrology/characteristic/evaluators.hpp"
#include "metrology/characteristic/feature_extent.hpp"
#include "metrology/fit/median_plane.hpp"
#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {
namespace {

// What the toleranced element is centred on: a plane, a line or a point.
using Target = std::variant<Plane, Line, Vec3>;

double distance(const Target& target, const Vec3& p) {
  if (const auto* plane = std::get_if<Plane>(&target)) return std::abs(residual(*plane, p));
  if (const auto* line = std::get_if<Line>(&target)) return residual(*line, p);
  return (p - std::get<Vec3>(target)).norm();
}

Vec3 direction_of(const Target& target) {
  if (const auto* plane = std::get_if<Plane>(&target)) return plane->axis;
  if (const auto* line = std::get_if<Line>(&target)) return line->axis;
  return Vec3::UnitX();
}

double farthest(const Target& target, const std::vector<Vec3>& points) {
  double most = 0.0;
  for (const Vec3& p : points) most = std::max(most, distance(target, p));
  return most;
}

// True position.
Target planned_place(const PlannedFeature& planned) {
  switch (planned.kind) {
    case FeatureKind::plane:
    case FeatureKind::point:
      return Plane{planned.point, unit(planned.axis)};
    case FeatureKind::line: {
      const Vec3 axis = unit(planned.axis);
      return Plane{planned.point, unit(planned.normal - planned.normal.dot(axis) * axis)};
    }
    case FeatureKind::sphere:
      return planned.point;
    case FeatureKind::cylinder:
    case FeatureKind::cone:
    case FeatureKind::circle:
    case FeatureKind::ruled:  // has no position
      break;
  }
  return Line{planned.point, unit(planned.axis)};
}

// How far points are off. Places are reported of measured points; those of an element move
// together.
NonNegative offsets(const Target& target, const std::vector<Vec3>& points) {
  NonNegative off;
  for (const Vec3& p : points) {
    if (const auto* plane = std::get_if<Plane>(&target)) {
      off.parts.push_back(residual(*plane, p));
      continue;
    }
    Vec3 apart;
    if (const auto* line = std::get_if<Line>(&target)) {
      const Vec3 w = p - line->point;
      apart = w - w.dot(line->axis.vec()) * line->axis.vec();
    } else {
      apart = p - std::get<Vec3>(target);
    }
    off.parts.insert(off.parts.end(), apart.begin(), apart.end());
  }
  off.rule.kind = std::holds_alternative<Plane>(target) ? NonNegativeKind::twice_largest_height
                                                        : NonNegativeKind::twice_largest;
  return off;
}

// What has to be in the zone: the points that are farthest off, and all that may be.
struct Content {
  std::vector<Vec3> farthest{};
  std::vector<Vec3> all{};
  std::vector<double> own{};  // as NonNegative
  bool is_measured = false;   // points of the surface itself
};
Result<Content> content(const FittedFeature& feature, Criterion criterion, const Target& target) {
  const FeatureKind kind = feature.planned->kind;
  const bool is_surface =
      kind == FeatureKind::plane || kind == FeatureKind::line || kind == FeatureKind::point;
  if (criterion == Criterion::minimum_zone && is_surface) {
    const std::vector<double> own(feature.points.size(), 1.0);
    return Content{feature.all_points(), feature.all_points(), own, true};
  }
  if (criterion == Criterion::minimum_zone &&
      (kind == FeatureKind::cylinder || kind == FeatureKind::cone)) {
    return median_line(feature).transform([](MedianLine&& line) {
      return Content{line.centres, line.centres, std::move(line.own)};
    });
  }
  const auto element = datum_element(feature, criterion);
  if (!element) return element.error();
  Vec3 toward = direction_of(target);
  if (const auto* plane = std::get_if<Plane>(&*element)) {
    toward -= toward.dot(plane->axis.vec()) * plane->axis.vec();
  }
  return Content{extremes(*feature.planned, *element, toward), outline(*feature.planned, *element)};
}

Result<Evaluated> centred_on(const Target& target, const FittedFeature& feature,
                             const Toleranced& what) {
  auto within = content(feature, what.planned.criterion, target);
  if (!within) return std::move(within).error();
  Evaluated zone;
  zone.value = 2.0 * farthest(target, within->farthest);
  zone.measurand = offsets(target, within->all);
  zone.measurand.own = std::move(within->own);
  if (within->is_measured) zone.measurand.places = std::move(within->all);
  return zone;
}

// Two sections of one feature; their common axis would run through both and hide what is asked.
Result<Evaluated> concentricity_within(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  const std::vector<std::size_t>& named = what.planned.sections;
  const Vec3 axis = unit(feature.planned->axis);
  const auto first = section_circle(feature, named.empty() ? 0 : named[0], axis);
  if (!first) return first.error();
  const auto second =
      section_circle(feature, named.empty() ? section_count(*feature.planned) - 1 : named[1], axis);
  if (!second) return second.error();
  const Vec3 apart = second->element.point - first->element.point;
  Evaluated zone;
  zone.measurand = length_of(2.0 * apart.cross(axis));
  zone.value = size_of(zone.measurand);
  zone.measurand.own = {4.0 * (centre_variance(*first) + centre_variance(*second))};
  return zone;
}

// The centres of the sections about the axis of the datum.
Result<Evaluated> concentricity_to_datum(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  const FittedFeature& datum = *what.features.back();
  const Line axis{point_of(datum.element), *axis_of(datum.element)};
  std::vector<std::size_t> sections = what.planned.sections;
  if (sections.empty()) {
    sections.resize(section_count(*feature.planned));
    std::iota(sections.begin(), sections.end(), std::size_t{0});
  }
  Evaluated zone;
  std::vector<Vec3> centres;
  std::vector<double> own;
  for (const std::size_t section : sections) {
    const auto circle = section_circle(feature, section, axis.axis);
    if (!circle) return circle.error();
    centres.push_back(circle->element.point);
    own.push_back(centre_variance(*circle));
  }
  zone.measurand = offsets(axis, centres);
  zone.measurand.own = std::move(own);
  zone.value = size_of(zone.measurand);
  return zone;
}

bool is_plane(const FittedFeature& feature) { return feature.planned->kind == FeatureKind::plane; }

// The datum of a symmetry: a face, two faces, or an axis.
Result<Target> symmetry_datum(std::span<const FittedFeature* const> datums, Criterion criterion) {
  if (!is_plane(*datums.front())) {
    const auto axis = common_axis(datums, criterion);
    if (!axis) return axis.error();
    return Target{*axis};
  }
  std::vector<Plane> faces;
  for (const FittedFeature* datum : datums) {
    const auto element = datum_element(*datum, criterion);
    if (!element) return element.error();
    faces.push_back(std::get<Plane>(*element));
  }
  if (faces.size() == 1) return Target{faces.front()};
  const double sense =
      sense_between(unit(datums[0]->planned->axis), unit(datums[1]->planned->axis));
  return Target{median_plane(faces[0], faces[1], sense)};
}

// Of two faces, as they are planned about their datum.
double planned_sense(const FittedFeature& first, const FittedFeature& second,
                     std::span<const FittedFeature* const> datums, bool datum_is_axis) {
  Vec3 direction = unit(datums.front()->planned->axis);
  if (!datum_is_axis && datums.size() == 2) {
    const Vec3 other = unit(datums.back()->planned->axis);
    direction += sense_between(direction, other) * other;
    direction.normalize();
  }
  return sense_towards(unit(first.planned->axis), unit(second.planned->axis), direction,
                       datum_is_axis);
}

Result<Evaluated> symmetry_zone(const Toleranced& what) {
  const std::span<const FittedFeature* const> features = what.features;
  const FittedFeature& first = *features.front();
  const std::size_t toleranced = is_plane(first) && features.size() > 2 ? 2 : 1;
  auto target = symmetry_datum(features.subspan(toleranced), what.planned.datum_criterion);
  if (!target) return target.error();
  if (!is_plane(first)) return centred_on(*target, first, what);
  const FittedFeature& last = *features[toleranced - 1];
  Plane median = std::get<Plane>(first.element);
  if (toleranced == 2) {
    const double sense = planned_sense(first, last, features.subspan(toleranced),
                                       std::holds_alternative<Line>(*target));
    median = median_plane(median, std::get<Plane>(last.element), sense);
  }
  if (const auto* axis = std::get_if<Line>(&*target)) {
    // The plane through the axis that is nearest to the toleranced one.
    const Vec3 along = axis->axis;
    const auto normal = UnitVec3::of(median.axis.vec() - median.axis.vec().dot(along) * along);
    if (!normal) {
      return error("datum-unsuitable"_id, "the datum axis is perpendicular to the faces",
                   "choose an axis that is along them");
    }
    target = Target{Plane{axis->point, *normal}};
  }
  const Vec3 normal = median.axis;
  const Vec3 wanted = direction_of(*target);
  const Vec3 middle = 0.5 * (first.planned->point + last.planned->point);
  Evaluated zone;
  std::vector<Vec3> ends;
  for (std::size_t i = 0; i < toleranced; ++i) {
    // The faces end where the median plane ends: half a width off along their normal.
    PlannedFeature end = *features[i]->planned;
    const Vec3 across = unit(end.axis);
    end.point += (middle - end.point).dot(across) * across;
    const auto points = extremes(end, median, wanted - wanted.dot(normal) * normal);
    zone.value = std::max(zone.value, 2.0 * farthest(*target, points));
    const std::vector<Vec3> all = outline(end, median);
    ends.insert(ends.end(), all.begin(), all.end());
  }
  zone.measurand = offsets(*target, ends);
  return zone;
}

}  // namespace

Result<Evaluated> evaluate_position(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  return centred_on(planned_place(*feature.planned), feature, what);
}

Result<Evaluated> evaluate_coaxiality(const Toleranced& what) {
  const std::span<const FittedFeature* const> features = what.features;
  const auto axis = common_axis(features.subspan(1), what.planned.datum_criterion);
  if (!axis) return axis.error();
  return centred_on(*axis, *features.front(), what);
}

Result<Evaluated> evaluate_concentricity(const Toleranced& what) {
  return what.features.size() == 1 ? concentricity_within(what) : concentricity_to_datum(what);
}

Result<Evaluated> evaluate_symmetry(const Toleranced& what) { return symmetry_zone(what); }

}  // namespace frustum::metrology
