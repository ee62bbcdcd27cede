#include "metrology/characteristic/fitted_feature.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/spline_surface.hpp"
#include "metrology/plan/nominal.hpp"

namespace frustum::metrology {
namespace {

// In the order of FeatureKind.
constexpr std::array kElements{ElementKind::plane,  ElementKind::cylinder, ElementKind::cone,
                               ElementKind::circle, ElementKind::line,     ElementKind::sphere,
                               ElementKind::plane,  ElementKind::plane};

// One touch tells a place along the planned normal and nothing else: a plane that keeps the planned
// normal, through the mean of what was touched.
Result<Fit<Element>> fit_touches(const PlannedFeature& planned, std::span<const Vec3> centres) {
  if (centres.empty()) return error("too-few-points"_id, "no point given, 1 needed");
  const UnitVec3 normal = unit(planned.axis);
  const double count = static_cast<double>(centres.size());
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : centres) mean += p / count;
  if (!mean.allFinite()) return error("point-not-finite"_id, "a coordinate is not a finite number");
  Fit<Element> fit;
  fit.element = Plane{mean, normal};
  for (const Vec3& p : centres) {
    fit.residuals.push_back((p - mean).dot(normal.vec()));
    fit.rms += fit.residuals.back() * fit.residuals.back() / count;
  }
  fit.rms = std::sqrt(fit.rms);
  const auto [low, high] = std::minmax_element(fit.residuals.begin(), fit.residuals.end());
  fit.form = *high - *low;
  fit.cofactor = Mat3::Zero();  // shift and tilts of a plane; the tilts are planned
  fit.cofactor(0, 0) = 1.0 / count;
  fit.covariance = Mat3::Zero();
  return fit;
}

// Nothing is fitted: deviations are those from the planned surface. The plane is no more than where
// it is.
Result<Fit<Element>> no_fit(const PlannedFeature& planned, std::span<const Vec3> centres,
                            double ball_radius) {
  if (centres.empty()) return error("too-few-points"_id, "no point given, 1 needed");
  const SplinePoint middle = planned.net.surface->at(0.5, 0.5);
  Fit<Element> fit;
  fit.element = Plane{middle.r, unit(middle.normal())};
  for (const Vec3& p : centres) {
    if (!p.allFinite()) return error("point-not-finite"_id, "a coordinate is not a finite number");
    fit.residuals.push_back(planned.net.surface->nearest(p).distance - ball_radius);
    fit.rms += fit.residuals.back() * fit.residuals.back() / static_cast<double>(centres.size());
  }
  fit.rms = std::sqrt(fit.rms);
  const auto [low, high] = std::minmax_element(fit.residuals.begin(), fit.residuals.end());
  fit.form = *high - *low;
  fit.cofactor = fit.covariance = Mat3::Zero();
  return fit;
}

// Of ball centres, or of surface points when the radius is 0.
std::vector<MeasuredPoint> on_net(const PlannedFeature& planned, const std::vector<Vec3>& centres,
                                  const std::vector<std::size_t>& sections, double ball_radius) {
  std::vector<MeasuredPoint> points;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const SplineFoot foot = planned.net.surface->nearest(centres[i]);
    points.push_back({centres[i] - ball_radius * foot.normal, foot.normal,
                      foot.distance - ball_radius, sections[i]});
  }
  return points;
}

Result<Fit<Element>> fit_planned(const PlannedFeature& planned, std::span<const Vec3> centres,
                                 double ball_radius, FitStart start) {
  if (planned.kind == FeatureKind::point) return fit_touches(planned, centres);
  if (planned.kind == FeatureKind::ruled) return no_fit(planned, centres, ball_radius);
  FitOptions options;
  options.expected = nominal_element(planned);
  const ElementKind kind = kElements.at(static_cast<std::size_t>(planned.kind));
  if (start == FitStart::anywhere) return fit_element(kind, centres, options);
  options.expected = offset(*options.expected, material_sign(planned) * ball_radius);
  return fit_nearby(kind, centres, options);
}

std::vector<double> numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

std::vector<Vec3> FittedFeature::section(std::size_t index) const {
  std::vector<Vec3> chosen;
  for (const MeasuredPoint& p : points) {
    if (p.section == index) chosen.push_back(p.point);
  }
  return chosen;
}

std::vector<Vec3> FittedFeature::all_points() const {
  std::vector<Vec3> all;
  for (const MeasuredPoint& p : points) all.push_back(p.point);
  return all;
}

Result<FittedFeature> fit_feature(const PlannedFeature& planned, const std::vector<Vec3>& centres,
                                  const std::vector<std::size_t>& sections, double ball_radius,
                                  FitStart start) {
  auto fit = fit_planned(planned, centres, ball_radius, start);
  if (!fit) {
    Diagnostics failure = std::move(fit).error();
    for (Diagnostic& d : failure) {
      d.message = fmt::format("feature '{}': {}", planned.name, d.message);
    }
    return failure;
  }
  return feature_from(planned, std::move(*fit), centres, sections, ball_radius);
}

Result<FittedFeature> feature_from(const PlannedFeature& planned, Fit<Element> fit,
                                   const std::vector<Vec3>& centres,
                                   const std::vector<std::size_t>& sections, double ball_radius) {
  if (const auto* cone = std::get_if<Cone>(&fit.element);
      cone != nullptr && cone->axis.vec().dot(planned.axis) < 0.0) {
    return error(
        "cone-opens-against-plan"_id,
        fmt::format("feature '{}': the measured cone opens against the planned axis", planned.name),
        "the axis of a cone points toward the growing radius");
  }
  if (planned.kind == FeatureKind::ruled) {
    return FittedFeature{&planned, fit.element, on_net(planned, centres, sections, ball_radius),
                         fit.form, fit.rms,     std::move(fit.cofactor)};
  }
  const Element centre_element = agreeing(fit.element, planned.axis);
  const double sign = material_sign(planned);
  // Residuals of a plane follow the normal that was fitted.
  const bool turned = planned.kind == FeatureKind::plane &&
                      axis_of(fit.element)->vec().dot(axis_of(centre_element)->vec()) < 0.0;
  FittedFeature feature{&planned, offset(centre_element, -sign * ball_radius),
                        {},       fit.form,
                        fit.rms,  std::move(fit.cofactor)};
  Vec3 line_normal = Vec3::Zero();
  if (auto* line = std::get_if<Line>(&feature.element)) {
    const Vec3 axis = line->axis;
    line_normal = (planned.normal - planned.normal.dot(axis) * axis).normalized();
    line->point -= ball_radius * line_normal;
  }
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Vec3 normal = planned.kind == FeatureKind::line
                            ? line_normal
                            : Vec3(sign * outward_normal(centre_element, centres[i]));
    feature.points.push_back({centres[i] - ball_radius * normal, normal,
                              planned.kind == FeatureKind::line
                                  ? (centres[i] - point_of(centre_element)).dot(line_normal)
                                  : (turned ? -sign : sign) * fit.residuals[i],
                              sections[i]});
  }
  return feature;
}

FittedFeature transformed(const Pose& to_from, FittedFeature feature) {
  feature.element = transformed(to_from, feature.element);
  for (MeasuredPoint& p : feature.points) {
    p.point = to_from.point(p.point);
    p.normal = to_from.direction(p.normal);
  }
  if (feature.planned->kind == FeatureKind::ruled) {
    // The planned surface stays in the frame of the plan, and the points move against it.
    std::vector<std::size_t> sections;
    for (const MeasuredPoint& p : feature.points) sections.push_back(p.section);
    feature.points = on_net(*feature.planned, feature.all_points(), sections, 0.0);
  }
  return feature;
}

Diagnostics about_section(const FittedFeature& feature, std::size_t section, Diagnostics faults) {
  const std::string& name = feature.planned->name;
  if (!feature.section(section).empty()) {
    for (Diagnostic& d : faults) {
      d.message = fmt::format("section {} of '{}': {}", section, name, d.message);
    }
    return faults;
  }
  std::set<std::size_t> measured;
  for (const MeasuredPoint& p : feature.points) measured.insert(p.section);
  return {error("section-without-points"_id,
                fmt::format("section {} of '{}' has no points, measured are {}", section, name,
                            fmt::join(measured, ", ")),
                "measure it, or name another section; the first is 0")};
}

MeasuredFeature summary(const FittedFeature& feature) {
  MeasuredFeature out;
  out.name = feature.planned->name;
  out.kind = std::string(name_of(feature.planned->kind));
  out.points = feature.points;
  out.form = feature.form;
  out.rms = feature.rms;
  out.compensation_difference = feature.compensation_difference;
  if (feature.planned->kind == FeatureKind::ruled) return out;
  std::visit(
      [&](const auto& e) {
        out.parameters["point"] = numbers(e.point);
        if constexpr (requires { e.axis; }) out.parameters["axis"] = numbers(e.axis);
        if constexpr (requires { e.radius; }) out.parameters["radius"] = {e.radius};
        if constexpr (requires { e.half_angle; }) out.parameters["half_angle"] = {e.half_angle};
      },
      feature.element);
  return out;
}

}  // namespace frustum::metrology
