#include "metrology/fitted_feature.hpp"

#include <fmt/format.h>

#include "metrology/nominal.hpp"

namespace frustum::metrology {
namespace {

ElementKind element_kind(FeatureKind kind) {
  switch (kind) {
    case FeatureKind::plane:
      return ElementKind::plane;
    case FeatureKind::cylinder:
      return ElementKind::cylinder;
    case FeatureKind::cone:
      return ElementKind::cone;
    case FeatureKind::circle:
      return ElementKind::circle;
    case FeatureKind::line:
      break;
  }
  return ElementKind::line;
}

Element agreeing(Element element, const Vec3& direction) {
  std::visit(
      [&](auto& e) {
        if constexpr (requires { e.axis; }) {
          if (e.axis.vec().dot(direction) < 0.0) e.axis = -e.axis;
        }
      },
      element);
  return element;
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
                                  const std::vector<std::size_t>& sections, double ball_radius) {
  auto fit = fit_element(element_kind(planned.kind), centres);
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
        fmt::format("feature '{}': the measured cone opens against the planned axis", planned.name),
        "the axis of a cone points toward the growing radius");
  }
  const Element centre_element = agreeing(fit.element, planned.axis);
  const double sign = material_sign(planned);
  FittedFeature feature{&planned, offset(centre_element, -sign * ball_radius),
                        {},       fit.form,
                        fit.rms,  std::move(fit.cofactor)};
  const Vec3 axis = axis_of(centre_element)->vec();
  const Vec3 line_normal = (planned.normal - planned.normal.dot(axis) * axis).normalized();
  if (auto* line = std::get_if<Line>(&feature.element)) line->point -= ball_radius * line_normal;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Vec3 normal = planned.kind == FeatureKind::line
                            ? line_normal
                            : Vec3(sign * outward_normal(centre_element, centres[i]));
    feature.points.push_back({centres[i] - ball_radius * normal, normal,
                              planned.kind == FeatureKind::line
                                  ? (centres[i] - point_of(centre_element)).dot(line_normal)
                                  : sign * fit.residuals[i],
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
  return feature;
}

MeasuredFeature summary(const FittedFeature& feature) {
  MeasuredFeature out;
  out.name = feature.planned->name;
  out.kind = std::string(name_of(feature.planned->kind));
  out.points = feature.points;
  out.form = feature.form;
  out.rms = feature.rms;
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
