#include "metrology/characteristic/standard_uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include "metrology/probing/probe_form.hpp"

namespace frustum::metrology {
namespace {

double square(double x) { return x * x; }

// Larger variance of the two tilts, per unit variance of a point.
double tilt_cofactor(const FittedFeature& feature) {
  Eigen::Index first = 2;  // line, cylinder, cone
  if (std::holds_alternative<Plane>(feature.element)) first = 1;
  if (std::holds_alternative<Circle>(feature.element)) first = 4;
  return std::max(feature.cofactor(first, first), feature.cofactor(first + 1, first + 1));
}

double centre_cofactor(const Fit<Circle>& circle) {
  return std::max(circle.cofactor(0, 0), circle.cofactor(1, 1));
}

// Of a point, by a probe that the statement of the machine does not contain: mean squares over all
// directions.
double probe_variance(const CmmModel& cmm) {
  if (cmm.kind == CmmKind::field || !cmm.probe) return 0.0;
  const ProbeErrors& probe = *cmm.probe;
  const double bend = bending(probe.force, cmm.stylus.value_or(Stylus{}));
  return square(probe.lobe) / 2.0 + (square(probe.ball_form) + square(bend)) / 3.0 +
         square(probe.repeatability) + square(probe.scan_noise);
}

// Of the growth of all lengths alike. What is not compensated counts whole.
double thermal_variance(const CmmModel& cmm) {
  if (!cmm.temperature) return 0.0;
  const ThermalState& t = *cmm.temperature;
  constexpr double kReference = 20.0;  // degC, ISO 1
  const double part = t.part - kReference;
  const double scales = t.scales - kReference;
  if (!t.compensated) return square(t.part_expansion * part - t.scale_expansion * scales);
  // Half widths: a third of the squares.
  return (square(t.sensor_error) * (square(t.part_expansion) + square(t.scale_expansion)) +
          square(t.expansion_error) * (square(part) + square(scales))) /
         3.0;
}

}  // namespace

PointUncertainty point_uncertainty(const CmmModel& cmm) {
  // k is in mm per um: 1 / k um per mm is 1e-3 / k.
  const double stated = cmm.length_per_error ? 0.5e-3 / *cmm.length_per_error : 0.0;
  const double point = 0.5 * cmm.e0_mm;
  const double probe = probe_variance(cmm);
  const double growth = thermal_variance(cmm);
  // A radius feels a growth whole, and a scale in one direction by half of the square.
  return {probe > 0.0 ? std::sqrt(square(point) + probe) : point,
          growth > 0.0 ? std::sqrt(square(stated) + 2.0 * growth) : stated};
}

double form_uncertainty(const PointUncertainty& u, double radius) {
  return std::sqrt(2.0 * square(u.probing) + 3.0 * square(u.scale * radius));
}

double straightness_uncertainty(const PointUncertainty& u) { return 2.0 * u.probing; }

double half_angle_uncertainty(const PointUncertainty& u, const FittedFeature& cone) {
  const double angle = std::get<Cone>(cone.element).half_angle;
  return std::sqrt(square(u.probing) * cone.cofactor(5, 5) +
                   1.5 * square(0.5 * u.scale * std::sin(2.0 * angle)));
}

double radius_uncertainty(const PointUncertainty& u, const FittedFeature& feature, double along) {
  double variance = 0.0;
  double radius = 0.0;
  if (const auto* cone = std::get_if<Cone>(&feature.element)) {
    const double c = std::cos(cone->half_angle);
    const Eigen::Vector2d gradient(1.0 / c,
                                   (cone->radius * std::sin(cone->half_angle) + along) / (c * c));
    variance = gradient.dot(feature.cofactor.block<2, 2>(4, 4) * gradient);
    radius = cone->section_radius(along);
  } else if (const auto* cylinder = std::get_if<Cylinder>(&feature.element)) {
    variance = feature.cofactor(4, 4);
    radius = cylinder->radius;
  } else if (const auto* circle = std::get_if<Circle>(&feature.element)) {
    variance = feature.cofactor(2, 2);
    radius = circle->radius;
  } else if (const auto* sphere = std::get_if<Sphere>(&feature.element)) {
    variance = feature.cofactor(3, 3);
    radius = sphere->radius;
  }
  return std::sqrt(square(u.probing) * variance + 0.5 * square(u.scale * radius));
}

double concentricity_uncertainty(const PointUncertainty& u, const Fit<Circle>& first,
                                 const Fit<Circle>& second, const FittedFeature& axis) {
  const double height =
      (first.element.point - second.element.point).dot(axis_of(axis.element)->vec());
  const double cofactor =
      centre_cofactor(first) + centre_cofactor(second) + square(height) * tilt_cofactor(axis);
  return 2.0 * std::sqrt(square(u.probing) * cofactor + square(u.scale * height));
}

double concentricity_uncertainty(const PointUncertainty& u, const Fit<Circle>& section,
                                 const FittedFeature& datum) {
  const double height =
      (section.element.point - point_of(datum.element)).dot(axis_of(datum.element)->vec());
  const double middle = std::max(datum.cofactor(0, 0), datum.cofactor(1, 1));
  const double cofactor = centre_cofactor(section) + middle + square(height) * tilt_cofactor(datum);
  return 2.0 * std::sqrt(square(u.probing) * cofactor + square(u.scale * height));
}

double perpendicularity_uncertainty(const PointUncertainty& u, const FittedFeature& toleranced,
                                    const FittedFeature& datum, double extent) {
  return extent * std::sqrt(square(u.probing) * (tilt_cofactor(toleranced) + tilt_cofactor(datum)) +
                            square(u.scale));
}

double place_uncertainty(const PointUncertainty& u, const FittedFeature& feature, double away) {
  // Shift and tilt as least_squares.hpp orders them.
  const bool is_plane = std::holds_alternative<Plane>(feature.element);
  const Eigen::Index shifts = is_plane ? 1 : 2;
  const Eigen::MatrixXd& q = feature.cofactor;
  double variance = 0.0;
  for (Eigen::Index k = 0; k < std::min(shifts, q.rows()); ++k) {
    variance = std::max(variance, q(k, k));
  }
  double tilt = 0.0;
  if (axis_of(feature.element) != nullptr && !std::holds_alternative<Circle>(feature.element)) {
    for (Eigen::Index k = shifts; k < std::min(shifts + 2, q.rows()); ++k) {
      tilt = std::max(tilt, q(k, k));
    }
  }
  const double reach = std::max(away, point_of(feature.element).norm());
  return 2.0 * std::sqrt(u.probing * u.probing * (variance + away * away * tilt) +
                         u.scale * u.scale * reach * reach);
}

}  // namespace frustum::metrology
