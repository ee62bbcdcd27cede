#include <algorithm>
#include <cmath>

#include "metrology/characteristic/datum_element.hpp"
#include "metrology/characteristic/feature_extent.hpp"
#include "metrology/characteristic/zone.hpp"

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
      break;
  }
  return Line{planned.point, unit(planned.axis)};
}

// The points that have to lie in the zone.
Result<std::vector<Vec3>> toleranced_points(const FittedFeature& feature, Criterion criterion,
                                            const Target& target) {
  const FeatureKind kind = feature.planned->kind;
  const bool is_surface =
      kind == FeatureKind::plane || kind == FeatureKind::line || kind == FeatureKind::point;
  if (criterion == Criterion::minimum_zone && is_surface) return feature.all_points();
  if (criterion == Criterion::minimum_zone &&
      (kind == FeatureKind::cylinder || kind == FeatureKind::cone)) {
    return median_line(feature);
  }
  const auto element = datum_element(feature, criterion);
  if (!element) return element.error();
  Vec3 toward = direction_of(target);
  if (const auto* plane = std::get_if<Plane>(&*element)) {
    toward -= toward.dot(plane->axis.vec()) * plane->axis.vec();
  }
  return extremes(*feature.planned, *element, toward);
}

double half_length(const std::vector<Vec3>& points) {
  return 0.5 * (points.back() - points.front()).norm();
}

Result<Zone> centred_on(const Target& target, const FittedFeature& feature,
                        const Toleranced& what) {
  const auto points = toleranced_points(feature, what.planned.criterion, target);
  if (!points) return points.error();
  Zone zone;
  zone.value = 2.0 * farthest(target, *points);
  zone.uncertainty = place_uncertainty(what.u, feature, half_length(*points));
  return zone;
}

// Of two faces, all points as far from the one as from the other.
Plane median_plane(const Plane& first, const Plane& second) {
  const double sense = first.axis.vec().dot(second.axis.vec()) < 0.0 ? -1.0 : 1.0;
  const Vec3 sum = first.axis.vec() + sense * second.axis.vec();
  const double offset =
      (first.axis.vec().dot(first.point) + sense * second.axis.vec().dot(second.point)) /
      sum.norm();
  const UnitVec3 normal = unit(sum);
  const Vec3 middle = 0.5 * (first.point + second.point);
  return {middle + (offset - middle.dot(normal.vec())) * normal.vec(), normal};
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
  return Target{faces.size() == 1 ? faces.front() : median_plane(faces[0], faces[1])};
}

Result<Zone> symmetry_zone(const Toleranced& what) {
  const std::span<const FittedFeature* const> features = what.features;
  const FittedFeature& first = *features.front();
  const std::size_t toleranced = is_plane(first) && features.size() > 2 ? 2 : 1;
  auto target = symmetry_datum(features.subspan(toleranced), what.planned.datum_criterion);
  if (!target) return target.error();
  if (!is_plane(first)) return centred_on(*target, first, what);
  const FittedFeature& last = *features[toleranced - 1];
  Plane median = std::get<Plane>(first.element);
  if (toleranced == 2) median = median_plane(median, std::get<Plane>(last.element));
  if (const auto* axis = std::get_if<Line>(&*target)) {
    // The plane through the axis that lies nearest to the toleranced one.
    const Vec3 along = axis->axis;
    const auto normal = UnitVec3::of(median.axis.vec() - median.axis.vec().dot(along) * along);
    if (!normal) {
      return error("the datum axis stands upright on the faces",
                   "choose an axis that lies along them");
    }
    target = Target{Plane{axis->point, *normal}};
  }
  const Vec3 normal = median.axis;
  const Vec3 wanted = direction_of(*target);
  const Vec3 middle = 0.5 * (first.planned->point + last.planned->point);
  Zone zone;
  for (std::size_t i = 0; i < toleranced; ++i) {
    // The faces end where the median plane ends: half a width off along their normal.
    PlannedFeature end = *features[i]->planned;
    const Vec3 across = unit(end.axis);
    end.point += (middle - end.point).dot(across) * across;
    const auto points = extremes(end, median, wanted - wanted.dot(normal) * normal);
    zone.value = std::max(zone.value, 2.0 * farthest(*target, points));
    zone.uncertainty =
        std::max(zone.uncertainty, place_uncertainty(what.u, *features[i], half_length(points)));
  }
  return zone;
}

}  // namespace

Result<Line> common_axis(std::span<const FittedFeature* const> datums, Criterion criterion) {
  if (datums.size() == 1) {
    const auto element = datum_element(*datums.front(), criterion);
    if (!element) return element.error();
    return Line{point_of(*element), *axis_of(*element)};
  }
  std::vector<Vec3> centres;
  for (const FittedFeature* datum : datums) {
    if (datum->planned->kind == FeatureKind::circle) {
      centres.push_back(point_of(datum->element));
      continue;
    }
    const auto of_datum = median_line(*datum);
    if (!of_datum) return of_datum.error();
    centres.insert(centres.end(), of_datum->begin(), of_datum->end());
  }
  const auto line = fit_line(centres);
  if (!line) return line.error();
  return line->element;
}

double place_uncertainty(const PointUncertainty& u, const FittedFeature& feature, double away) {
  // Shift and tilt as least_squares.hpp orders them.
  const bool is_plane = std::holds_alternative<Plane>(feature.element);
  const Eigen::Index shifts = is_plane ? 1 : 2;
  const Eigen::MatrixXd& q = feature.cofactor;
  double variance = 0.0;
  for (Eigen::Index k = 0; k < std::min(shifts, q.rows()); ++k) {
    variance = std::max(variance, q(k, k));
  }
  double tilt = 0.0;
  if (axis_of(feature.element) != nullptr && !std::holds_alternative<Circle>(feature.element)) {
    for (Eigen::Index k = shifts; k < std::min(shifts + 2, q.rows()); ++k) {
      tilt = std::max(tilt, q(k, k));
    }
  }
  const double reach = std::max(away, point_of(feature.element).norm());
  return 2.0 * std::sqrt(u.probing * u.probing * (variance + away * away * tilt) +
                         u.scale * u.scale * reach * reach);
}

Result<Zone> location_zone(const Toleranced& what) {
  const std::span<const FittedFeature* const> features = what.features;
  switch (what.planned.kind) {
    case CharacteristicKind::position:
      return centred_on(planned_place(*features.front()->planned), *features.front(), what);
    case CharacteristicKind::coaxiality: {
      const auto axis = common_axis(features.subspan(1), what.planned.datum_criterion);
      if (!axis) return axis.error();
      return centred_on(*axis, *features.front(), what);
    }
    default:
      return symmetry_zone(what);
  }
}

}  // namespace frustum::metrology
