// Straightness of lines, of generatrices of a cylinder or cone (of several the worst), of an axis.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

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

struct PlacedPoint {
  double angle = 0.0;
  PlanarPoint point{};
};

double reach_of(const PlanarProfile& profile) {
  const auto [low, high] = std::ranges::minmax_element(profile, {}, &PlanarPoint::along);
  return high->along - low->along;
}
bool goes_along(const PlanarProfile& profile, double least) {
  return profile.size() >= 3 && reach_of(profile) >= least;
}

// Groups of neighbours that are no more than `apart` from each other. One that is wider than half a
// degree is parted at smaller gaps, as one is where each part goes along `least` by itself: all
// points of dense sections are neighbours.
std::vector<PlanarProfile> parted_by_angle(std::span<const PlacedPoint> placed, double apart,
                                           double least) {
  constexpr double kOneAngle = 0.5 * kRadPerDeg;
  constexpr double kLeastGap = 1e-6;  // rad: nearer points of a scan are at one angle
  std::vector<PlanarProfile> all;
  for (std::size_t i = 0, end = 0; i < placed.size(); i = end) {
    end = i + 1;
    while (end < placed.size() && placed[end].angle - placed[end - 1].angle <= apart) ++end;
    const auto group = placed.subspan(i, end - i);
    const bool is_wide = group.back().angle - group.front().angle > kOneAngle;
    std::vector<PlanarProfile> parts;
    if (apart > kLeastGap) parts = parted_by_angle(group, 0.5 * apart, least);
    const bool all_go = std::ranges::all_of(
        parts, [&](const PlanarProfile& part) { return goes_along(part, least); });
    if (parts.size() > 1 && (is_wide || all_go)) {
      std::ranges::move(parts, std::back_inserter(all));
      continue;
    }
    all.emplace_back();
    for (const PlacedPoint& p : group) all.back().push_back(p.point);
  }
  return all;
}

// Points at one angle about the axis, within half a degree, that are three or more and go along
// half of the feature or farther.
std::vector<PlanarProfile> generatrices(const FittedFeature& feature) {
  const Vec3 axis = *axis_of(feature.element);
  const AngleFrame frame = angle_frame(feature);
  const double sign = material_sign(*feature.planned);
  std::vector<PlacedPoint> placed;
  PlanarProfile whole;
  for (const MeasuredPoint& p : feature.points) {
    const Vec3 w = p.point - point_of(feature.element);
    whole.push_back({w.dot(axis), sign * w.cross(axis).norm()});
    placed.push_back({angle_of(w, frame), whole.back()});
  }
  if (placed.empty()) return {};
  std::ranges::stable_sort(placed, {}, &PlacedPoint::angle);
  // Angles begin after the widest gap, so that no generatrix is cut where they start.
  std::size_t first = 0;
  double widest = placed.front().angle + 2.0 * std::numbers::pi - placed.back().angle;
  for (std::size_t i = 1; i < placed.size(); ++i) {
    if (placed[i].angle - placed[i - 1].angle <= widest) continue;
    widest = placed[i].angle - placed[i - 1].angle;
    first = i;
  }
  for (std::size_t i = 0; i < first; ++i) placed[i].angle += 2.0 * std::numbers::pi;
  std::rotate(placed.begin(), placed.begin() + static_cast<std::ptrdiff_t>(first), placed.end());
  const double least = 0.5 * reach_of(whole);
  std::vector<PlanarProfile> all = parted_by_angle(placed, 0.5 * kRadPerDeg, least);
  std::erase_if(all, [&](const PlanarProfile& p) { return !goes_along(p, least); });
  return all;
}

// The narrowest cylinder about the least-squares axis; of several lines the widest of them.
Evaluated straightness_about_axis(const Toleranced& what) {
  NonNegative off{{NonNegativeKind::twice_largest}, {}, {}};
  for (const FittedFeature* feature : what.features) {
    const Vec3 axis = *axis_of(feature->element);
    for (const Vec3& p : feature->all_points()) {
      const Vec3 from = p - point_of(feature->element);
      const Vec3 across = from - from.dot(axis) * axis;
      off.places.push_back(p);
      off.parts.insert(off.parts.end(), across.begin(), across.end());
    }
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
  const auto is_line = [](const FittedFeature* f) { return f->planned->kind == FeatureKind::line; };
  // Lines without further wishes: all their points about their axes, in space.
  if (is_plain(what.planned) && std::ranges::all_of(what.features, is_line)) {
    return straightness_about_axis(what);
  }
  std::vector<PlanarProfile> profiles;
  for (const FittedFeature* feature : what.features) {
    const std::vector<PlanarProfile> its =
        is_line(feature) ? std::vector<PlanarProfile>{profile_of_line(*feature)}
                         : generatrices(*feature);
    if (its.empty()) {
      return error(
          "too-few-points"_id,
          fmt::format("no three points of '{}' are on one generatrix", feature->planned->name),
          "plan three sections or more with the same number of points");
    }
    profiles.insert(profiles.end(), its.begin(), its.end());
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
