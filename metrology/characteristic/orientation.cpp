// Parallelism, perpendicularity and angularity.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "metrology/characteristic/datum_element.hpp"
#include "metrology/characteristic/evaluators.hpp"
#include "metrology/characteristic/feature_extent.hpp"
#include "metrology/fit/minimax/smallest_circle.hpp"
#include "metrology/plan/strategy.hpp"

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
NonNegative cylinder_around(const MedianLine& line, const Vec3& direction) {
  const std::vector<Vec3>& points = line.centres;
  const auto [u, v] = tangents(unit(direction));
  std::vector<Eigen::Vector2d> across;
  for (const Vec3& p : points) {
    const Vec3 w = p - points.front();
    across.emplace_back(w.dot(u), w.dot(v));
  }
  const Eigen::Vector2d centre = smallest_circle(across).centre;
  NonNegative off{{NonNegativeKind::twice_largest}, {}, {}, line.own};
  for (const Eigen::Vector2d& p : across) {
    const Vec3 apart = (p - centre).x() * u + (p - centre).y() * v;
    off.parts.insert(off.parts.end(), apart.begin(), apart.end());
  }
  return off;
}

Vec3 surface_normal(const PlannedFeature& line, const Vec3& direction) {
  return unit(line.normal - line.normal.dot(direction) * direction);
}

// Of the directions at the planned angle to the datum, the one along which the points are least
// high.
Vec3 least_high(const Wanted& want, const std::vector<Vec3>& points) {
  constexpr int kStarts = 72;
  constexpr double kStep = 2.0 * std::numbers::pi / kStarts;
  const auto at = [&](double turn) -> Vec3 {
    return rotation_about(want.datum, turn) * want.direction;
  };
  const auto height = [&](double turn) { return range_along(points, at(turn)); };
  double best = 0.0;
  double least = height(best);
  for (int i = 1; i < kStarts; ++i) {
    if (const double here = height(i * kStep); here < least) {
      least = here;
      best = i * kStep;
    }
  }
  // Between two neighbours of the best the height falls to one lowest place: golden section.
  constexpr double kGolden = 0.6180339887498949;
  double low = best - kStep;
  double high = best + kStep;
  while (high - low > 1e-13) {
    const double left = high - kGolden * (high - low);
    const double right = low + kGolden * (high - low);
    if (!(low < left && left < right && right < high)) break;
    if (height(left) < height(right)) {
      high = right;
    } else {
      low = left;
    }
  }
  const double middle = 0.5 * (low + high);
  return height(middle) < least ? at(middle) : at(best);
}

// What the points themselves need: planes for a plane, for a line on a surface and where the datum
// leaves one direction free; a cylinder for an axis.
Result<NonNegative> zone_of_surface(const FittedFeature& feature, const Wanted& want) {
  if (feature.planned->kind == FeatureKind::plane) {
    const std::vector<Vec3> points = feature.all_points();
    if (want.freedom == Freedom::none) return heights_along(want.direction, points);
    if (!want.across) return heights_along(least_high(want, points), points);
    Constraints keep;
    keep.perpendicular_to = unit(want.datum);
    const auto zone = associated(feature, Criterion::minimum_zone, keep);
    if (!zone) return zone.error();
    return NonNegative{
        {NonNegativeKind::peak_to_valley}, zone->fit.residuals, feature.all_points()};
  }
  return heights_along(surface_normal(*feature.planned, want.direction), feature.all_points());
}
Result<NonNegative> zone_of_axis(const FittedFeature& feature, const Wanted& want) {
  const auto line = median_line(feature);
  if (!line) return line.error();
  if (want.freedom == Freedom::none) return cylinder_around(*line, want.direction);
  const Vec3 across = want.datum - want.datum.dot(want.direction) * want.direction;
  NonNegative heights = heights_along(across.normalized(), line->centres);
  heights.places.clear();
  heights.own = line->own;
  return heights;
}
Result<NonNegative> zone_of_points(const FittedFeature& feature, const Wanted& want) {
  const FeatureKind kind = feature.planned->kind;
  if (kind != FeatureKind::plane && kind != FeatureKind::line) return zone_of_axis(feature, want);
  return zone_of_surface(feature, want).transform([](NonNegative&& heights) {
    heights.own.assign(heights.parts.size(), 1.0);
    return std::move(heights);
  });
}

// What the associated element needs over its extent.
Evaluated zone_of_element(const PlannedFeature& planned, const Element& element,
                          const Wanted& want) {
  Evaluated zone;
  if (planned.kind == FeatureKind::plane) {
    const Vec3 normal = *axis_of(element);
    const Vec3 steepest = want.direction - want.direction.dot(normal) * normal;
    zone.value = range_along(extremes(planned, element, steepest), want.direction);
    zone.measurand = heights_along(want.direction, outline(planned, element));
    zone.measurand.places.clear();  // all corners move together
    return zone;
  }
  const std::vector<Vec3> points = extremes(planned, element, want.direction);
  const Vec3 run = points.back() - points.front();
  const Vec3 along =
      planned.kind == FeatureKind::line ? surface_normal(planned, want.direction) : want.direction;
  const Vec3 rise = run.dot(along) * along;
  zone.measurand = length_of(planned.kind == FeatureKind::line ? rise : Vec3(run - rise));
  zone.value = size_of(zone.measurand);
  return zone;
}

// Length of the toleranced feature over which it may tilt.
double tilted_length(const PlannedFeature& planned, const Vec3& datum_direction) {
  if (planned.kind != FeatureKind::plane) {
    const AxialExtent range = axial_extent(planned);
    return range.to - range.from;
  }
  const Vec3 normal = unit(planned.axis);
  const auto direction = UnitVec3::of(datum_direction - datum_direction.dot(normal) * normal);
  const auto across = [&](const Vec3& u, const Vec3& v) {
    // Without a direction in the plane (datum along its normal) the larger side counts.
    if (!direction) return std::max(u.norm(), v.norm());
    return std::abs(u.dot(direction->vec())) + std::abs(v.dot(direction->vec()));
  };
  if (const auto* e = std::get_if<RectangleExtent>(&planned.extent)) return across(e->u, e->v);
  if (const auto* e = std::get_if<RadialExtent>(&planned.extent)) return 2.0 * e->outer;
  if (const auto* s = std::get_if<GridStrategy>(&planned.strategy)) return across(s->u, s->v);
  const auto& rings = std::get<RingStrategy>(planned.strategy).rings;
  return 2.0 * *std::max_element(rings.begin(), rings.end());
}

// From two least-squares elements alone: how far one tilts over its planned extent.
Evaluated tilt_of_elements(const Toleranced& what) {
  const FittedFeature& toleranced = *what.features.front();
  const FittedFeature& datum = *what.features.back();
  const Vec3 a = *axis_of(toleranced.element);
  const Vec3 b = *axis_of(datum.element);
  const bool alike = std::holds_alternative<Plane>(toleranced.element) ==
                     std::holds_alternative<Plane>(datum.element);
  // Two planes or two axes are perpendicular when their directions are; a plane and an axis when
  // theirs are parallel.
  const double length = tilted_length(*toleranced.planned, unit(datum.planned->axis));
  const Vec3 tilt = length * (alike ? Vec3(a.dot(b), 0.0, 0.0) : Vec3(a.cross(b)));
  Evaluated found{tilt.norm()};
  found.measurand = length_of(tilt);
  return found;
}

// The zone of ISO 1101 about the element or its points.
Result<Evaluated> orientation_zone(const Toleranced& what) {
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
  Evaluated zone;
  if (of_points) {
    auto points = zone_of_points(feature, want);
    if (!points) return std::move(points).error();
    zone.measurand = std::move(*points);
    zone.value = size_of(zone.measurand);
  } else {
    zone = zone_of_element(*feature.planned, *element, want);
  }
  return zone;
}

}  // namespace

Result<Evaluated> evaluate_orientation(const Toleranced& what) { return orientation_zone(what); }

Result<Evaluated> evaluate_perpendicularity(const Toleranced& what) {
  // How a line on a surface runs within it is its scan path's, not the part's.
  const bool of_elements = is_plain(what.planned) && what.planned.features.size() == 2 &&
                           what.planned.datum_criterion == Criterion::least_squares &&
                           what.features.front()->planned->kind != FeatureKind::line;
  return of_elements ? Result<Evaluated>(tilt_of_elements(what)) : orientation_zone(what);
}

}  // namespace frustum::metrology
