// Features measured without a machine: the planned points moved with the part, each off along its
// normal as a test says.
// Units: mm, rad.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/plan/strategy.hpp"

namespace frustum::metrology::measured {

using Deviation = std::function<double(const Vec3& planned)>;  // mm, out of the material

// Spread over a ball by the golden angle; other features as they plan it.
inline std::vector<PlannedPoint> touches(const PlannedFeature& planned) {
  if (planned.kind != FeatureKind::sphere) return planned_points(planned);
  std::vector<PlannedPoint> points;
  for (int i = 0; i < 25; ++i) {
    const double z = (i + 0.5) / 25.0;
    const double turn = 2.399963229728653 * i;
    const Vec3 e(std::sqrt(1.0 - z * z) * std::cos(turn), std::sqrt(1.0 - z * z) * std::sin(turn),
                 z);
    points.push_back({planned.point + planned.radius * e, e, 0});
  }
  return points;
}

// `planned` outlives the feature.
inline FittedFeature feature(const PlannedFeature& planned, const Pose& lies = {},
                             const Deviation& deviation = {}) {
  std::vector<Vec3> points;
  std::vector<std::size_t> sections;
  for (const PlannedPoint& p : touches(planned)) {
    const double off = deviation ? deviation(p.point) : 0.0;
    points.push_back(lies.point(p.point + off * p.normal));
    sections.push_back(p.section);
  }
  auto fitted = fit_feature(planned, points, sections, 0.0);
  EXPECT_TRUE(fitted) << planned.name;
  return fitted ? *fitted : FittedFeature{};
}

inline PlannedFeature cylinder(std::string name, const Vec3& point, const Vec3& axis, double radius,
                               std::vector<double> sections = {-10.0, 0.0, 10.0}, int count = 36) {
  PlannedFeature f;
  f.name = std::move(name);
  f.kind = FeatureKind::cylinder;
  f.point = point;
  f.axis = axis;
  f.radius = radius;
  f.strategy = SectionStrategy{std::move(sections), count};
  return f;
}
inline PlannedFeature plane(std::string name, const Vec3& point, const Vec3& normal, const Vec3& u,
                            const Vec3& v) {
  PlannedFeature f;
  f.name = std::move(name);
  f.point = point;
  f.axis = normal;
  f.strategy = GridStrategy{u, v, 5, 3};
  return f;
}
inline PlannedFeature rings(std::string name, const Vec3& point, const Vec3& normal,
                            std::vector<double> radii) {
  PlannedFeature f;
  f.name = std::move(name);
  f.point = point;
  f.axis = normal;
  f.strategy = RingStrategy{std::move(radii), 24};
  return f;
}
inline PlannedFeature line(std::string name, const Vec3& point, const Vec3& axis,
                           const Vec3& normal) {
  PlannedFeature f;
  f.name = std::move(name);
  f.kind = FeatureKind::line;
  f.point = point;
  f.axis = axis;
  f.normal = normal;
  f.strategy = LineStrategy{-15.0, 15.0, 7};
  return f;
}
inline PlannedFeature point(std::string name, const Vec3& place, const Vec3& normal) {
  PlannedFeature f;
  f.name = std::move(name);
  f.kind = FeatureKind::point;
  f.point = place;
  f.axis = normal;
  f.strategy = single_touch();
  return f;
}

// With a tolerance of 1 mm.
inline PlannedCharacteristic characteristic(CharacteristicKind kind,
                                            std::vector<std::string> features,
                                            Criterion criterion = Criterion::least_squares) {
  PlannedCharacteristic c;
  c.name = "c";
  c.kind = kind;
  c.features = std::move(features);
  c.tolerance = 1.0;
  c.criterion = criterion;
  return c;
}

// Turns by `angle` about an axis through `pivot`.
inline Pose turned(const Vec3& axis, double angle, const Vec3& pivot = Vec3::Zero()) {
  const Mat3 rotation = rotation_about(axis, angle);
  return {rotation, pivot - rotation * pivot};
}

}  // namespace frustum::metrology::measured
