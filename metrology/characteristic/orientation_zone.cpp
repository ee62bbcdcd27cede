#include <algorithm>
#include <cmath>

#include "metrology/characteristic/datum_element.hpp"
#include "metrology/characteristic/feature_extent.hpp"
#include "metrology/characteristic/zone.hpp"
#include "metrology/fit/minimax/smallest_circle.hpp"

namespace frustum::metrology {
namespace {

// Sine and cosine below this are those of planned 0 and 90 deg, written in decimals.
constexpr double kPlanned = 1e-6;

enum class Freedom { none, about_datum };

// The direction that the toleranced element should have: with the planned angle to the datum, else
// as it is.
struct Wanted {
  Vec3 direction = Vec3::UnitZ();
  Freedom freedom = Freedom::none;
  Vec3 datum = Vec3::UnitZ();
  bool across = false;  // perpendicular to the datum
};

Wanted wanted(const Vec3& actual, const Vec3& planned, const Vec3& datum,
              const Vec3& planned_datum) {
  const double cosine = planned.dot(planned_datum);
  const double sine = planned.cross(planned_datum).norm();
  if (sine < kPlanned)
    return {actual.dot(datum) < 0.0 ? Vec3(-datum) : datum, Freedom::none, datum};
  const auto across = UnitVec3::of(actual - actual.dot(datum) * datum);
  const Vec3 off = across ? across->vec() : perpendicular_to(datum);
  if (std::abs(cosine) < kPlanned) return {off, Freedom::about_datum, datum, true};
  return {cosine * datum + sine * off, Freedom::about_datum, datum};
}

double range_along(const std::vector<Vec3>& points, const Vec3& direction) {
  double low = points.front().dot(direction);
  double high = low;
  for (const Vec3& p : points) {
    low = std::min(low, p.dot(direction));
    high = std::max(high, p.dot(direction));
  }
  return high - low;
}

// How far the points are off the middle of the narrowest cylinder along that direction.
NonNegative cylinder_around(const std::vector<Vec3>& points, const Vec3& direction) {
  const auto [u, v] = tangents(unit(direction));
  std::vector<Eigen::Vector2d> across;
  for (const Vec3& p : points) {
    const Vec3 w = p - points.front();
    across.emplace_back(w.dot(u), w.dot(v));
  }
  const Eigen::Vector2d centre = smallest_circle(across).centre;
  NonNegative off{{NonNegativeKind::twice_largest}, {}, {}};
  for (const Eigen::Vector2d& p : across) {
    const Vec3 apart = (p - centre).x() * u + (p - centre).y() * v;
    off.parts.insert(off.parts.end(), apart.begin(), apart.end());
  }
  return off;
}

Vec3 surface_normal(const PlannedFeature& line, const Vec3& direction) {
  return unit(line.normal - line.normal.dot(direction) * direction);
}

// What the points themselves need: planes for a plane, for a line on a surface and where the datum
// leaves one direction free; a cylinder for an axis.
Result<NonNegative> zone_of_points(const FittedFeature& feature, const Wanted& want) {
  if (feature.planned->kind == FeatureKind::plane) {
    if (!want.across) return heights_along(want.direction, feature.all_points());
    Constraints keep;
    keep.perpendicular_to = unit(want.datum);
    const auto zone = associated(feature, Criterion::minimum_zone, keep);
    if (!zone) return zone.error();
    return NonNegative{
        {NonNegativeKind::peak_to_valley}, zone->fit.residuals, feature.all_points()};
  }
  if (feature.planned->kind == FeatureKind::line) {
    return heights_along(surface_normal(*feature.planned, want.direction), feature.all_points());
  }
  const auto centres = median_line(feature);
  if (!centres) return centres.error();
  if (want.freedom == Freedom::none) return cylinder_around(*centres, want.direction);
  const Vec3 across = want.datum - want.datum.dot(want.direction) * want.direction;
  NonNegative heights = heights_along(across.normalized(), *centres);
  heights.places.clear();
  return heights;
}

// What the associated element needs over its extent.
Zone zone_of_element(const PlannedFeature& planned, const Element& element, const Wanted& want) {
  Zone zone;
  if (planned.kind == FeatureKind::plane) {
    const Vec3 normal = *axis_of(element);
    const Vec3 steepest = want.direction - want.direction.dot(normal) * normal;
    zone.value = range_along(extremes(planned, element, steepest), want.direction);
    zone.magnitude = heights_along(want.direction, outline(planned, element));
    zone.magnitude.places.clear();  // all corners move together
    return zone;
  }
  const std::vector<Vec3> points = extremes(planned, element, want.direction);
  const Vec3 run = points.back() - points.front();
  const Vec3 along =
      planned.kind == FeatureKind::line ? surface_normal(planned, want.direction) : want.direction;
  const Vec3 rise = run.dot(along) * along;
  zone.magnitude = length_of(planned.kind == FeatureKind::line ? rise : Vec3(run - rise));
  zone.value = size_of(zone.magnitude);
  return zone;
}

double largest_extent(const PlannedFeature& planned, const Element& element) {
  const std::vector<Vec3> points = extremes(planned, element, Vec3::UnitX());
  return (points.back() - points.front()).norm();
}

}  // namespace

Result<Zone> orientation_zone(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  const bool of_points = what.planned.criterion == Criterion::minimum_zone;
  const auto element =
      datum_element(feature, of_points ? Criterion::least_squares : what.planned.criterion);
  if (!element) return element.error();
  const Vec3 planned = unit(feature.planned->axis);
  Wanted want{planned, Freedom::none, planned};
  if (what.features.size() > 1) {
    const FittedFeature& datum = *what.features.back();
    const auto datum_as = datum_element(datum, what.planned.datum_criterion);
    if (!datum_as) return datum_as.error();
    want = wanted(*axis_of(*element), planned, *axis_of(*datum_as), unit(datum.planned->axis));
  }
  Zone zone;
  if (of_points) {
    auto points = zone_of_points(feature, want);
    if (!points) return std::move(points).error();
    zone.magnitude = std::move(*points);
    zone.value = size_of(zone.magnitude);
  } else {
    zone = zone_of_element(*feature.planned, *element, want);
  }
  zone.uncertainty = perpendicularity_uncertainty(what.u, feature, *what.features.back(),
                                                  largest_extent(*feature.planned, *element));
  return zone;
}

}  // namespace frustum::metrology
