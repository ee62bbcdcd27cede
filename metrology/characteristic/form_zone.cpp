#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "metrology/characteristic/datum_element.hpp"
#include "metrology/characteristic/feature_extent.hpp"
#include "metrology/characteristic/gaussian_filter.hpp"
#include "metrology/characteristic/harmonics.hpp"
#include "metrology/characteristic/zone.hpp"
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

Result<Zone> straightness_zone(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  const bool is_line = feature.planned->kind == FeatureKind::line;
  const std::vector<PlanarProfile> profiles =
      is_line ? std::vector<PlanarProfile>{profile_of_line(feature)} : generatrices(feature);
  if (profiles.empty()) {
    return error(
        fmt::format("no three points of '{}' lie on one generatrix", feature.planned->name),
        "plan three sections or more with the same number of points");
  }
  Zone zone{0.0, straightness_uncertainty(what.u), {}, {}};
  for (const PlanarProfile& profile : profiles) {
    const auto deviations = straightness_of(profile, what.planned);
    if (!deviations) return deviations.error();
    zone.value = std::max(
        zone.value, form_parameter(what.planned.parameter.value_or(FormParameter::t), *deviations));
  }
  return zone;
}

// The narrowest zone of three centres that lie nearly on a line: the height over their longest
// side.
double lowest_height(const std::vector<Vec3>& c) {
  const double longest =
      std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
  return (c[1] - c[0]).cross(c[2] - c[0]).norm() / longest;
}

Result<Zone> axis_straightness_zone(const Toleranced& what) {
  const auto centres = median_line(*what.features.front());
  if (!centres) return centres.error();
  if (centres->size() < 3) {
    return error(fmt::format("'{}' has two sections, and two centres are always straight",
                             what.features.front()->planned->name),
                 "measure three sections or more");
  }
  const double uncertainty = straightness_uncertainty(what.u);
  if (centres->size() == 3 && what.planned.criterion == Criterion::minimum_zone) {
    return Zone{lowest_height(*centres), uncertainty, {}, {}};
  }
  const auto line = associate(ElementKind::line, *centres, {.criterion = what.planned.criterion});
  if (!line) return line.error();
  double farthest = 0.0;
  for (const Vec3& p : *centres) farthest = std::max(farthest, residual(line->fit.element, p));
  return Zone{2.0 * farthest, uncertainty, {}, {}};
}

// The circle of the profile, its deviations filtered, associated anew by the criterion.
Result<std::vector<double>> round_deviations(const RoundProfile& profile, double radius,
                                             const PlannedCharacteristic& planned) {
  std::vector<double> kept = profile.deviation;
  if (planned.filter) {
    auto band = closed_band(*planned.filter, profile.angle, kept);
    if (!band) return band;
    kept = std::move(*band);
  } else if (planned.criterion == Criterion::least_squares) {
    return kept;
  }
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const double r = radius + kept[i];
    points.emplace_back(r * std::cos(profile.angle[i]), r * std::sin(profile.angle[i]), 0.0);
  }
  auto circle = associate("circle2d", points, {.criterion = planned.criterion});
  if (!circle) return std::move(circle).error();
  return std::move(circle->fit.residuals);
}

Result<Zone> roundness_zone(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  const std::size_t section = what.planned.sections.empty() ? 0 : what.planned.sections.front();
  const std::vector<Vec3> points = at_one_height(feature, section, *axis_of(feature.element));
  auto profile = roundness(points, angle_frame(feature));
  if (!profile) return about_section(feature, section, std::move(profile).error());
  const double radius = fit_circle(points)->element.radius;
  auto deviations = round_deviations(*profile, radius, what.planned);
  if (!deviations) return std::move(deviations).error();
  profile->deviation = std::move(*deviations);
  std::vector<double> outward = profile->deviation;
  for (double& d : outward) d *= material_sign(*feature.planned);
  Zone zone;
  zone.value = form_parameter(what.planned.parameter.value_or(FormParameter::t), outward);
  zone.uncertainty = form_uncertainty(what.u, feature.planned->radius);
  if (what.planned.harmonics > 0) {
    auto waves = harmonics(profile->angle, profile->deviation, what.planned.harmonics);
    if (!waves) return std::move(waves).error();
    zone.harmonics = std::move(*waves);
  }
  zone.profile = std::move(*profile);
  return zone;
}

// Cylindricity, cone form, flatness: all points from one element.
Result<Zone> surface_zone(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  std::vector<double> outward;
  if (what.planned.criterion == Criterion::least_squares) {
    for (const MeasuredPoint& p : feature.points) outward.push_back(p.deviation);
  } else {
    auto association = associated(feature, what.planned.criterion);
    if (!association) return std::move(association).error();
    outward = std::move(association->fit.residuals);
    for (double& d : outward) d *= material_sign(*feature.planned);
  }
  Zone zone;
  zone.value = form_parameter(what.planned.parameter.value_or(FormParameter::t), outward);
  zone.uncertainty = form_uncertainty(what.u, feature.planned->radius);
  if (feature.planned->kind == FeatureKind::plane) return zone;
  const AngleFrame frame = angle_frame(feature);
  for (const MeasuredPoint& p : feature.points) {
    zone.profile.angle.push_back(angle_of(p.point - point_of(feature.element), frame));
  }
  zone.profile.deviation = std::move(outward);
  return zone;
}

}  // namespace

double form_parameter(FormParameter parameter, const std::vector<double>& deviations) {
  const auto [low, high] = std::minmax_element(deviations.begin(), deviations.end());
  switch (parameter) {
    case FormParameter::t:
      return *high - *low;
    case FormParameter::p:
      return *high;
    case FormParameter::v:
      return -*low;
    case FormParameter::q:
      break;
  }
  const double squares =
      std::inner_product(deviations.begin(), deviations.end(), deviations.begin(), 0.0);
  return std::sqrt(squares / static_cast<double>(deviations.size()));
}

double angle_of(const Vec3& w, const AngleFrame& frame) {
  const double angle = std::atan2(w.dot(frame.axis.vec().cross(frame.zero)), w.dot(frame.zero));
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

AngleFrame angle_frame(const FittedFeature& feature) {
  return {unit(feature.planned->axis), zero_direction(*feature.planned)};
}

Result<Zone> form_zone(const Toleranced& what) {
  switch (what.planned.kind) {
    case CharacteristicKind::roundness:
      return roundness_zone(what);
    case CharacteristicKind::straightness:
      return straightness_zone(what);
    case CharacteristicKind::axis_straightness:
      return axis_straightness_zone(what);
    default:
      return surface_zone(what);
  }
}

}  // namespace frustum::metrology
