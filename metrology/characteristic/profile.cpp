// Profile of a line or of surfaces.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "metrology/characteristic/evaluators.hpp"
#include "metrology/fit/best_fit.hpp"
#include "metrology/plan/nominal.hpp"

namespace frustum::metrology {
namespace {

struct ProbedSurface {
  const FittedFeature* feature = nullptr;
  NominalSurface planned{};
  std::vector<Vec3> points{};
};

ProbedSurface probed(const FittedFeature& feature, std::vector<Vec3> points) {
  return {&feature, planned_surface(*feature.planned), std::move(points)};
}

// The planned geometry laid into the points, from where `start` laid it.
Result<BestFit> laid_into(const std::vector<ProbedSurface>& surfaces, const Pose& start = {}) {
  const Pose started_from_measured = start.inverse();
  std::vector<PointOnElement> all;
  for (const ProbedSurface& s : surfaces) {
    for (const Vec3& p : s.points) all.push_back({started_from_measured.point(p), &s.planned});
  }
  auto fit = best_fit(all, {}, Telling::steady);
  if (fit) fit->measured_from_planned = start * fit->measured_from_planned;
  return fit;
}

// The same where the points tell all that matters: one section of a part that is askew is oval, and
// nothing says that the part is not.
Result<Pose> told_place(const std::vector<ProbedSurface>& surfaces) {
  const auto fit = laid_into(surfaces);
  if (!fit) return fit.error();
  constexpr double kHarmless = 1e-9;  // mm: what a form is exact to
  if (fit->bend_of_untold <= kHarmless) return fit->measured_from_planned;
  std::vector<std::string> names;
  for (const ProbedSurface& s : surfaces) names.push_back(s.feature->planned->name);
  return error(
      "place-not-identified"_id,
      fmt::format("the points of '{}' do not identify how the part lies: turned by 1 deg in "
                  "a direction that they leave open, it deviates by up to {:.3g} um, which "
                  "a floating profile would count as form",
                  fmt::join(names, "', '"), fit->bend_of_untold * kUmPerMm),
      "probe two sections or more, apart from each other, or refer the profile to a datum "
      "system");
}

// Out of the material, feature after feature.
std::vector<double> profile_deviations(const std::vector<ProbedSurface>& surfaces,
                                       const Pose& measured_from_planned) {
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
  Pose place;
  if (what.planned.floating) {
    const auto told = told_place({probed(feature, feature.all_points())});
    if (!told) return told.error();
    place = *told;
  }
  Evaluated worst;
  NonNegative all{{NonNegativeKind::twice_largest_height}, {}, {}};
  for (const std::size_t section : sections) {
    const std::vector<Vec3> points = feature.section(section);
    if (points.empty()) return about_section(feature, section, {});
    const std::vector<ProbedSurface> cut{probed(feature, points)};
    Pose section_place;
    if (what.planned.floating) {
      const auto laid = laid_into(cut, place);
      if (!laid) return about_section(feature, section, laid.error());
      section_place = laid->measured_from_planned;
    }
    std::vector<double> found = profile_deviations(cut, section_place);
    const double value = all.rule(found);
    const bool is_first = all.parts.empty();
    all.parts.insert(all.parts.end(), found.begin(), found.end());
    all.places.insert(all.places.end(), points.begin(), points.end());
    if (!is_first && value <= worst.value) continue;
    worst.value = value;
    worst.profile = {};
    if (is_round(feature.planned->kind)) {
      worst.profile = plotted(feature, points, std::move(found));
    }
  }
  all.own.assign(all.parts.size(), 1.0);
  worst.measurand = std::move(all);
  return worst;
}

Result<Evaluated> profile_of_surfaces(const Toleranced& what) {
  std::vector<ProbedSurface> surfaces;
  for (const FittedFeature* feature : what.features) {
    surfaces.push_back(probed(*feature, feature->all_points()));
  }
  Pose place;
  if (what.planned.floating) {
    const auto told = told_place(surfaces);
    if (!told) return told.error();
    place = *told;
  }
  std::vector<double> found = profile_deviations(surfaces, place);
  Evaluated zone;
  zone.measurand = {{NonNegativeKind::twice_largest_height}, found, {}};
  zone.measurand.own.assign(found.size(), 1.0);
  // Near points of different surfaces are not alike.
  if (surfaces.size() == 1) zone.measurand.places = surfaces.front().points;
  zone.value = size_of(zone.measurand);
  const FittedFeature& first = *what.features.front();
  if (surfaces.size() == 1 && is_round(first.planned->kind)) {
    zone.profile = plotted(first, surfaces.front().points, std::move(found));
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
