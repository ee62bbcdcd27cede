#include "metrology/characteristic/round_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "metrology/plan/strategy.hpp"

namespace frustum::metrology {

Result<RoundProfile> roundness(std::span<const Vec3> points, const AngleFrame& angles) {
  auto fit = fit_circle(points);
  if (!fit) return std::move(fit).error();
  RoundProfile profile;
  profile.peak_to_valley = fit->form;
  profile.deviation = std::move(fit->residuals);
  for (const Vec3& p : points) {
    profile.angle.push_back(angle_of(p - fit->element.point, angles));
  }
  return profile;
}

Result<RoundProfile> equivalent_cone_form(std::span<const Vec3> points, double half_angle,
                                          const UnitVec3& toward_apex, const AngleFrame& angles) {
  const auto circle = fit_circle(points);
  if (!circle) return circle.error();
  const Vec3 normal = circle->element.axis;
  const Vec3 axis = normal.dot(toward_apex.vec()) < 0.0 ? Vec3(-normal) : normal;
  const Vec3 foot = circle->element.point - circle->element.radius * std::tan(half_angle) * axis;
  // The polar plot turns about the measured axis.
  const Vec3 zero = (angles.zero - angles.zero.dot(axis) * axis).normalized();
  const AngleFrame about{axis.dot(angles.axis.vec()) < 0.0 ? unit(-axis) : unit(axis), zero};
  RoundProfile profile;
  std::vector<Vec3> polar;
  for (const Vec3& p : points) {
    const double angle = angle_of(p - circle->element.point, about);
    const double d = (p - foot).norm();
    profile.angle.push_back(angle);
    polar.emplace_back(d * std::cos(angle), d * std::sin(angle), 0.0);
  }
  auto fit = fit_circle_2d(polar);
  if (!fit) return std::move(fit).error();
  profile.deviation = std::move(fit->residuals);
  const auto [low, high] = std::minmax_element(profile.deviation.begin(), profile.deviation.end());
  profile.peak_to_valley = *high - *low;
  return profile;
}

Result<std::vector<Vec3>> at_one_height(const FittedFeature& feature, std::size_t section,
                                        const Vec3& along) {
  constexpr double kHighest = 0.1;  // of the radius
  std::vector<Vec3> points = feature.section(section);
  const auto* cone = std::get_if<Cone>(&feature.element);
  if (cone == nullptr && !std::holds_alternative<Cylinder>(feature.element)) return points;
  const Vec3 axis = *axis_of(feature.element);
  const double half_angle = cone == nullptr ? 0.0 : cone->half_angle;
  Vec3 centroid = Vec3::Zero();
  for (const Vec3& p : points) centroid += p / static_cast<double>(points.size());
  double low = 0.0;
  double high = 0.0;
  double radius = 0.0;
  for (Vec3& p : points) {
    const Vec3 w = p - point_of(feature.element);
    const Vec3 lateral = w - w.dot(axis) * axis;
    const Vec3 generatrix =
        std::cos(half_angle) * axis + std::sin(half_angle) * lateral.normalized();
    const double height = (p - centroid).dot(along);
    low = std::min(low, height);
    high = std::max(high, height);
    radius = std::max(radius, lateral.norm());
    p -= height / generatrix.dot(along) * generatrix;
  }
  if (high - low > kHighest * radius) {
    return about_section(
        feature, section,
        {error(
            "section-height"_id,
            fmt::format("its points are {:.3g} mm apart along the axis, more than a tenth of the "
                        "radius",
                        high - low),
            "measure sections across the axis; all points together have a cylindricity")});
  }
  return points;
}

Result<Fit<Circle>> section_circle(const FittedFeature& feature, std::size_t section,
                                   const Vec3& along) {
  const auto points = at_one_height(feature, section, along);
  if (!points) return points.error();
  auto circle = fit_circle(*points);
  if (!circle) return about_section(feature, section, std::move(circle).error());
  return circle;
}

double centre_variance(const Fit<Circle>& circle) {
  return std::max(circle.cofactor(0, 0), circle.cofactor(1, 1));
}

double angle_of(const Vec3& w, const AngleFrame& frame) {
  const double angle = std::atan2(w.dot(frame.axis.vec().cross(frame.zero)), w.dot(frame.zero));
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

AngleFrame angle_frame(const FittedFeature& feature) {
  return {unit(feature.planned->axis), zero_direction(*feature.planned)};
}

}  // namespace frustum::metrology
