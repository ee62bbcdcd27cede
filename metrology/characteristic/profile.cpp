// Profile of a line or of surfaces.
#include <algorithm>
#include <cmath>
#include <set>

#include "metrology/characteristic/evaluators.hpp"
#include "metrology/fit/best_fit.hpp"
#include "metrology/plan/nominal.hpp"

namespace frustum::metrology {
namespace {

struct ProbedSurface {
  const FittedFeature* feature = nullptr;
  Element planned{};
  std::vector<Vec3> points{};
};

// Out of the material, feature after feature.
Result<std::vector<double>> profile_deviations(const std::vector<ProbedSurface>& surfaces,
                                               bool floating) {
  Pose measured_from_planned;
  if (floating) {
    std::vector<PointOnElement> all;
    for (const ProbedSurface& s : surfaces) {
      for (const Vec3& p : s.points) all.push_back({p, &s.planned});
    }
    const auto fit = best_fit(all);
    if (!fit) return fit.error();
    measured_from_planned = fit->measured_from_planned;
  }
  const Pose planned_from_measured = measured_from_planned.inverse();
  std::vector<double> found;
  for (const ProbedSurface& s : surfaces) {
    const double sign = material_sign(*s.feature->planned);
    for (const Vec3& p : s.points) {
      found.push_back(sign * residual(s.planned, planned_from_measured.point(p)));
    }
  }
  return found;
}

RoundProfile plotted(const FittedFeature& feature, const std::vector<Vec3>& points,
                     std::vector<double> deviation) {
  RoundProfile profile;
  const AngleFrame frame = angle_frame(feature);
  for (const Vec3& p : points) profile.angle.push_back(angle_of(p - feature.planned->point, frame));
  profile.deviation = std::move(deviation);
  return profile;
}

Result<Evaluated> profile_of_sections(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  std::set<std::size_t> sections(what.planned.sections.begin(), what.planned.sections.end());
  if (sections.empty()) {
    for (const MeasuredPoint& p : feature.points) sections.insert(p.section);
  }
  Evaluated worst;
  NonNegative all{{NonNegativeKind::twice_largest_height}, {}, {}};
  for (const std::size_t section : sections) {
    const std::vector<Vec3> points = feature.section(section);
    if (points.empty()) return about_section(feature, section, {});
    auto found = profile_deviations({{&feature, planned_surface(*feature.planned), points}},
                                    what.planned.floating);
    if (!found) return about_section(feature, section, std::move(found).error());
    const double value = all.rule(*found);
    const bool is_first = all.parts.empty();
    all.parts.insert(all.parts.end(), found->begin(), found->end());
    all.places.insert(all.places.end(), points.begin(), points.end());
    if (!is_first && value <= worst.value) continue;
    worst.value = value;
    worst.profile = {};
    if (is_round(feature.planned->kind)) {
      worst.profile = plotted(feature, points, std::move(*found));
    }
  }
  all.own.assign(all.parts.size(), 1.0);
  worst.measurand = std::move(all);
  return worst;
}

Result<Evaluated> profile_of_surfaces(const Toleranced& what) {
  std::vector<ProbedSurface> surfaces;
  for (const FittedFeature* feature : what.features) {
    surfaces.push_back({feature, planned_surface(*feature->planned), feature->all_points()});
  }
  auto found = profile_deviations(surfaces, what.planned.floating);
  if (!found) return std::move(found).error();
  Evaluated zone;
  zone.measurand = {{NonNegativeKind::twice_largest_height}, *found, {}};
  zone.measurand.own.assign(found->size(), 1.0);
  // Near points of different surfaces are not alike.
  if (surfaces.size() == 1) zone.measurand.places = surfaces.front().points;
  zone.value = size_of(zone.measurand);
  const FittedFeature& first = *what.features.front();
  if (surfaces.size() == 1 && is_round(first.planned->kind)) {
    zone.profile = plotted(first, surfaces.front().points, std::move(*found));
  }
  return zone;
}

}  // namespace

Result<Evaluated> evaluate_line_profile(const Toleranced& what) {
  return profile_of_sections(what);
}

Result<Evaluated> evaluate_surface_profile(const Toleranced& what) {
  return profile_of_surfaces(what);
}

}  // namespace frustum::metrology
