// Roundness, cylindricity, cone form and flatness by any criterion, parameter and filter; the
// equivalent form of a cone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/linear_algebra.hpp"
#include "metrology/characteristic/datum_element.hpp"
#include "metrology/characteristic/evaluators.hpp"
#include "metrology/characteristic/gaussian_filter.hpp"
#include "metrology/characteristic/harmonics.hpp"
#include "metrology/fit/element_model.hpp"
#include "metrology/plan/nominal.hpp"

namespace frustum::metrology {
namespace {

// The circle of the profile, its deviations filtered, associated anew by the criterion.
Result<std::vector<double>> round_deviations(const RoundProfile& profile,
                                             std::span<const Vec3> section,
                                             const PlannedCharacteristic& planned) {
  std::vector<double> kept = profile.deviation;
  if (planned.filter) {
    auto band = closed_band(*planned.filter, profile.angle, kept);
    if (!band) return band;
    kept = std::move(*band);
  } else if (planned.criterion == Criterion::least_squares) {
    return kept;
  }
  const double radius = fit_circle(section)->element.radius;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const double r = radius + kept[i];
    points.emplace_back(r * std::cos(profile.angle[i]), r * std::sin(profile.angle[i]), 0.0);
  }
  auto circle = associate("circle2d", points, {.criterion = planned.criterion});
  if (!circle) return std::move(circle).error();
  return std::move(circle->fit.residuals);
}

// An element through as many points as it has parameters leaves no form, whatever the part is like.
std::optional<Diagnostic> without_redundancy(std::size_t parameters, std::size_t points,
                                             std::string_view element) {
  if (points > parameters) return std::nullopt;
  return error(
      "too-few-points"_id,
      fmt::format("{} points have no form: a {} goes through all of them", points, element),
      fmt::format("measure {} or more", parameters + 1));
}

// A circle has no axis but that of its own points. Heights over its plane tilt that, and make a
// form of a round part; no matter where they are much less than the form.
std::optional<Diagnostic> uneven(const std::vector<Vec3>& points, double form_mm) {
  constexpr double kShare = 0.2;  // of the form: what is made of heights is estimated from above
  Vec3 centroid = Vec3::Zero();
  for (const Vec3& p : points) centroid += p / static_cast<double>(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& p : points) spread += (p - centroid) * (p - centroid).transpose();
  const SymmetricEigen eigen = symmetric_eigen(spread / static_cast<double>(points.size()));
  const Vec3 normal = eigen.vectors.col(0);
  double low = 0.0;
  double high = 0.0;
  double squares = 0.0;
  for (const Vec3& p : points) {
    const double height = (p - centroid).dot(normal);
    low = std::min(low, height);
    high = std::max(high, height);
    squares += height * height / static_cast<double>(points.size());
  }
  const double width = std::sqrt(std::max(0.0, eigen.values[1]));
  const double tilt = std::sqrt(squares) / width;
  const double made = (high - low) * tilt + 0.5 * width * tilt * tilt;
  if (!(made > kShare * form_mm)) return std::nullopt;
  return error(
      "section-height"_id,
      fmt::format("its points are {:.3g} mm apart along its axis, which makes up to {:.2g} "
                  "um of a form of {:.2g} um",
                  high - low, 1e3 * made, 1e3 * form_mm),
      "measure at one height, or plan a cylinder, whose axis does not come of one section");
}

// Peak to valley of deviations, each of a point of its own.
NonNegative of_points(const std::vector<double>& deviations, std::vector<Vec3> places) {
  NonNegative form{{NonNegativeKind::peak_to_valley}, deviations, std::move(places)};
  form.own.assign(deviations.size(), 1.0);
  return form;
}

// One section as it stands alone: the profile is what is plotted, its deviations the form.
using SectionForm = Result<Evaluated> (*)(const Toleranced&, std::size_t section);

// The worst section counts. How large the form of each may be is told of all of them together.
Result<Evaluated> worst_section(const Toleranced& what, SectionForm form_of) {
  Evaluated worst;
  NonNegative all{{NonNegativeKind::peak_to_valley}, {}, {}};
  for (const std::size_t section : sections_of(what)) {
    auto form = form_of(what, section);
    if (!form) return form;
    const NonNegative& own = form->measurand;
    all.rule.rows.push_back(own.parts.size());
    all.parts.insert(all.parts.end(), own.parts.begin(), own.parts.end());
    all.places.insert(all.places.end(), own.places.begin(), own.places.end());
    all.own.insert(all.own.end(), own.own.begin(), own.own.end());
    if (worst.profile.angle.empty() || form->value > worst.value) worst = std::move(*form);
  }
  if (all.rule.rows.size() == 1) all.rule.rows.clear();
  worst.measurand = std::move(all);
  return worst;
}

Result<Evaluated> roundness_of(const Toleranced& what, std::size_t section) {
  const FittedFeature& feature = *what.features.front();
  auto points = at_one_height(feature, section, *axis_of(feature.element));
  if (!points) return std::move(points).error();
  auto profile = roundness(*points, angle_frame(feature));
  if (!profile) return about_section(feature, section, std::move(profile).error());
  if (auto few = without_redundancy(3, points->size(), "circle")) {
    return about_section(feature, section, {*std::move(few)});
  }
  if (std::holds_alternative<Circle>(feature.element)) {
    if (auto fault = uneven(*points, profile->peak_to_valley)) {
      return about_section(feature, section, {*std::move(fault)});
    }
  }
  auto deviations = round_deviations(*profile, *points, what.planned);
  if (!deviations) return std::move(deviations).error();
  profile->deviation = std::move(*deviations);
  std::vector<double> outward = profile->deviation;
  for (double& d : outward) d *= material_sign(*feature.planned);
  Evaluated form;
  form.value = form_parameter(what.planned.parameter.value_or(FormParameter::t), outward);
  if (what.planned.harmonics > 0) {
    auto waves = harmonics(profile->angle, profile->deviation, what.planned.harmonics);
    if (!waves) return std::move(waves).error();
    form.harmonics = std::move(*waves);
  }
  form.measurand = of_points(profile->deviation, *std::move(points));
  form.has_shape = is_plain(what.planned);
  form.profile = std::move(*profile);
  return form;
}

Result<Evaluated> equivalent_form_of(const Toleranced& what, std::size_t section) {
  const FittedFeature& feature = *what.features.front();
  auto points = at_one_height(feature, section, *axis_of(feature.element));
  if (!points) return std::move(points).error();
  auto profile = equivalent_cone_form(*points, feature.planned->half_angle,
                                      -unit(feature.planned->axis), angle_frame(feature));
  if (!profile) return about_section(feature, section, std::move(profile).error());
  if (auto few = without_redundancy(3, points->size(), "circle")) {
    return about_section(feature, section, {*std::move(few)});
  }
  Evaluated form;
  form.value = profile->peak_to_valley;
  form.measurand = of_points(profile->deviation, *std::move(points));
  form.profile = std::move(*profile);
  return form;
}

FittedFeature beside(const Seam& seam, const FittedFeature& feature) {
  FittedFeature rest = feature;
  const AngleFrame frame = angle_frame(feature);
  const Vec3 centre = point_of(feature.element);
  std::erase_if(rest.points, [&](const MeasuredPoint& p) {
    const double from_seam = angle_of(p.point - centre, frame) - seam.at;
    // 1e-9 rad: a point on the limit is within it.
    return std::abs(std::remainder(from_seam, 2.0 * std::numbers::pi)) <= seam.within + 1e-9;
  });
  return rest;
}

// The form of all points, and beside it that of those off the seam.
Result<Evaluated> with_and_without_seam(const Toleranced& what, SectionForm form_of) {
  auto whole = worst_section(what, form_of);
  if (!whole || !what.planned.seam) return whole;
  const FittedFeature rest = beside(*what.planned.seam, *what.features.front());
  const auto off_seam = worst_section({what.planned, {&rest}}, form_of);
  if (!off_seam) return off_seam;
  whole->without_seam = off_seam->value;
  return whole;
}

}  // namespace

Result<Evaluated> evaluate_roundness(const Toleranced& what) {
  return with_and_without_seam(what, roundness_of);
}

Result<Evaluated> evaluate_equivalent_cone_form(const Toleranced& what) {
  return with_and_without_seam(what, equivalent_form_of);
}

Result<Evaluated> evaluate_surface_form(const Toleranced& what) {
  const FittedFeature& feature = *what.features.front();
  const ElementKind kind = kind_of(feature.element);
  if (auto few =
          without_redundancy(parameters_of(kind).size(), feature.points.size(), name_of(kind))) {
    few->message = fmt::format("feature '{}': {}", feature.planned->name, few->message);
    return *std::move(few);
  }
  std::vector<double> outward;
  if (what.planned.criterion == Criterion::least_squares) {
    for (const MeasuredPoint& p : feature.points) outward.push_back(p.deviation);
  } else {
    auto association = associated(feature, what.planned.criterion);
    if (!association) return std::move(association).error();
    outward = std::move(association->fit.residuals);
    for (double& d : outward) d *= material_sign(*feature.planned);
  }
  Evaluated form;
  form.value = form_parameter(what.planned.parameter.value_or(FormParameter::t), outward);
  form.measurand = of_points(outward, feature.all_points());
  form.has_shape = is_plain(what.planned);
  if (feature.planned->kind == FeatureKind::plane) return form;
  const AngleFrame frame = angle_frame(feature);
  for (const MeasuredPoint& p : feature.points) {
    form.profile.angle.push_back(angle_of(p.point - point_of(feature.element), frame));
  }
  form.profile.deviation = std::move(outward);
  return form;
}

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

}  // namespace frustum::metrology
