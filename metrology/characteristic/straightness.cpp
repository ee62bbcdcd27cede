// Straightness of lines, of the generatrices of a cylinder or cone (the worst), of an axis.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "metrology/characteristic/evaluators.hpp"
#include "metrology/characteristic/feature_extent.hpp"
#include "metrology/characteristic/gaussian_filter.hpp"
#include "metrology/fit/association.hpp"
#include "metrology/plan/nominal.hpp"
#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {
namespace {

// One generatrix: places in the half plane of its axis.
struct PlanarPoint {
  double along = 0.0;
  double across = 0.0;  // out of the material
};
using PlanarProfile = std::vector<PlanarPoint>;

// Distances of a profile from the straight line that the criterion lays through it.
Result<std::vector<double>> straight_deviations(const PlanarProfile& profile, Criterion criterion) {
  std::vector<Vec3> points;
  for (const PlanarPoint& p : profile) points.emplace_back(p.along, p.across, 0.0);
  Line line;
  if (criterion == Criterion::least_squares) {
    const auto fit = fit_line(points);
    if (!fit) return fit.error();
    line = fit->element;
  } else {
    const auto association = associate("line2d", points, {.criterion = criterion});
    if (!association) return association.error();
    line = std::get<Line>(association->fit.element);
  }
  const Vec3 axis = line.axis.vec().x() < 0.0 ? Vec3(-line.axis.vec()) : line.axis.vec();
  const Vec3 normal(-axis.y(), axis.x(), 0.0);
  std::vector<double> deviations;
  for (const Vec3& p : points) deviations.push_back((p - line.point).dot(normal));
  return deviations;
}

Result<std::vector<double>> straightness_of(PlanarProfile profile,
                                            const PlannedCharacteristic& planned) {
  if (planned.filter) {
    // Deviations from the straight line are filtered; the slope is none of the filter's business.
    auto deviations = straight_deviations(profile, Criterion::least_squares);
    if (!deviations) return deviations;
    std::vector<double> along;
    for (const PlanarPoint& p : profile) along.push_back(p.along);
    const auto kept = open_band(*planned.filter, along, *deviations);
    if (!kept) return kept;
    for (std::size_t i = 0; i < profile.size(); ++i) profile[i].across = (*kept)[i];
  }
  return straight_deviations(profile, planned.criterion);
}

PlanarProfile profile_of_line(const FittedFeature& feature) {
  const Vec3 axis = *axis_of(feature.element);
  const Vec3& written = feature.planned->normal;
  const Vec3 normal = (written - written.dot(axis) * axis).normalized();
  PlanarProfile profile;
  for (const MeasuredPoint& p : feature.points) {
    const Vec3 w = p.point - point_of(feature.element);
    profile.push_back({w.dot(axis), w.dot(normal)});
  }
  return profile;
}

// Points at one angle about the axis, within half a degree, that are three or more.
std::vector<PlanarProfile> generatrices(const FittedFeature& feature) {
  constexpr double kOneAngle = 0.5 * kRadPerDeg;
  const Vec3 axis = *axis_of(feature.element);
  const AngleFrame frame = angle_frame(feature);
  const double sign = material_sign(*feature.planned);
  std::vector<std::pair<double, PlanarPoint>> placed;
  for (const MeasuredPoint& p : feature.points) {
    const Vec3 w = p.point - point_of(feature.element);
    placed.emplace_back(angle_of(w, frame), PlanarPoint{w.dot(axis), sign * w.cross(axis).norm()});
  }
  std::sort(placed.begin(), placed.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<PlanarProfile> all;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (i == 0 || placed[i].first - placed[i - 1].first > kOneAngle) all.emplace_back();
    all.back().push_back(placed[i].second);
  }
  // The first and the last may be one, cut where the angles start.
  if (all.size() > 1 &&
      placed.front().first + 2.0 * std::numbers::pi - placed.back().first <= kOneAngle) {
    all.front().insert(all.front().end(), all.back().begin(), all.back().end());
    all.pop_back();
  }
  std::erase_if(all, [](const PlanarProfile& p) { return p.size() < 3; });
  return all;
}

// The narrowest cylinder about the least-squares axis.
Evaluated straightness_about_axis(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  const Vec3 axis = *axis_of(feature.element);
  NonNegative off{{NonNegativeKind::twice_largest}, {}, feature.all_points()};
  for (const Vec3& p : off.places) {
    const Vec3 from = p - point_of(feature.element);
    const Vec3 across = from - from.dot(axis) * axis;
    off.parts.insert(off.parts.end(), across.begin(), across.end());
  }
  off.own.assign(off.places.size(), 1.0);
  Evaluated found{size_of(off)};
  found.measurand = std::move(off);
  return found;
}

// The narrowest zone of three centres that lie nearly on a line: the height over their longest
// side.
double lowest_height(const std::vector<Vec3>& c) {
  const double longest =
      std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
  return (c[1] - c[0]).cross(c[2] - c[0]).norm() / longest;
}

}  // namespace

Result<Evaluated> evaluate_straightness(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  const bool is_line = feature.planned->kind == FeatureKind::line;
  // A line without further wishes: all its points about its axis, in space.
  if (is_line && is_plain(what.planned)) return straightness_about_axis(what);
  const std::vector<PlanarProfile> profiles =
      is_line ? std::vector<PlanarProfile>{profile_of_line(feature)} : generatrices(feature);
  if (profiles.empty()) {
    return error(
        "too-few-points"_id,
        fmt::format("no three points of '{}' are on one generatrix", feature.planned->name),
        "plan three sections or more with the same number of points");
  }
  Evaluated zone;
  zone.has_shape = false;
  NonNegative& all = zone.measurand;
  all.rule.kind = NonNegativeKind::peak_to_valley;
  for (const PlanarProfile& profile : profiles) {
    const auto deviations = straightness_of(profile, what.planned);
    if (!deviations) return deviations.error();
    all.rule.rows.push_back(deviations->size());
    all.parts.insert(all.parts.end(), deviations->begin(), deviations->end());
    all.own.resize(all.parts.size(), 1.0);
    zone.value = std::max(
        zone.value, form_parameter(what.planned.parameter.value_or(FormParameter::t), *deviations));
  }
  return zone;
}

Result<Evaluated> evaluate_axis_straightness(const Toleranced& what) {
  auto median = median_line(*what.features.front());
  if (!median) return std::move(median).error();
  const std::vector<Vec3>& centres = median->centres;
  if (centres.size() < 3) {
    return error("too-few-points"_id,
                 fmt::format("'{}' has two sections, and two centres are always straight",
                             what.features.front()->planned->name),
                 "measure three sections or more");
  }
  const bool narrowest = centres.size() == 3 && what.planned.criterion == Criterion::minimum_zone;
  const Criterion criterion = narrowest ? Criterion::least_squares : what.planned.criterion;
  const auto line = associate(ElementKind::line, centres, {.criterion = criterion});
  if (!line) return line.error();
  const Element& axis = line->fit.element;
  Evaluated zone;
  zone.has_shape = false;
  zone.measurand.rule.kind = NonNegativeKind::twice_largest;
  zone.measurand.own = std::move(median->own);
  for (const Vec3& p : centres) {
    const Vec3 w = p - point_of(axis);
    const Vec3 across = w - w.dot(axis_of(axis)->vec()) * axis_of(axis)->vec();
    zone.measurand.parts.insert(zone.measurand.parts.end(), across.begin(), across.end());
  }
  zone.value = narrowest ? lowest_height(centres) : size_of(zone.measurand);
  return zone;
}

}  // namespace frustum::metrology
