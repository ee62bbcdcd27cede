// A small part with every feature a cone test piece has, as an exact body, and the plan that
// measures it.
//
// Base disc with top z = 0 (plane A), cylinder C of radius 25 up to z = 15, cone of half angle 30
// deg on it (radius 22 at z = 15, top at z = 30), groove along Y whose left face is at x = 40.
// Units: mm, rad.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>

#include "metrology/plan/inspection_plan.hpp"
#include "metrology/probing/surface_probe.hpp"

namespace frustum::metrology::test_part {

constexpr double kHalfAngle = 30.0 * kRadPerDeg;

// Material where `depth` is negative. Contacts are found by walking and bisection.
struct ImplicitBody {
  std::function<double(const Vec3&)> depth;
  Pose workpiece_from_body{};

  [[nodiscard]] std::optional<Touch> touch(const Vec3& start, const UnitVec3& direction,
                                           double length_mm) const {
    const Pose body_from_workpiece = workpiece_from_body.inverse();
    const auto at = [&](double t) {
      return depth(body_from_workpiece.point(start + t * direction.vec()));
    };
    if (at(0.0) <= 0.0) return std::nullopt;
    constexpr double kStep = 0.1;  // thinner walls than that do not occur here
    for (double t = 0.0; t < length_mm; t += kStep) {
      double out = t;
      double in = std::min(t + kStep, length_mm);
      if (at(in) > 0.0) continue;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (out + in);
        (at(middle) > 0.0 ? out : in) = middle;
      }
      const Vec3 point = start + in * direction.vec();
      return Touch{point, normal_at(body_from_workpiece.point(point))};
    }
    return std::nullopt;
  }

 private:
  // Central differences over 2e-4 mm: 1e-8 rad, whose square is what reaches the ball centre.
  [[nodiscard]] Vec3 normal_at(const Vec3& x) const {
    constexpr double kH = 1e-4;
    Vec3 gradient;
    for (int i = 0; i < 3; ++i) {
      const Vec3 h = kH * Vec3::Unit(i);
      gradient[i] = depth(x + h) - depth(x - h);
    }
    return workpiece_from_body.direction(gradient.normalized());
  }
};

struct Flaws {
  double lobe = 0.0;              // mm, amplitude of three lobes on the cone, along its normal
  double cone_shift = 0.0;        // mm along x
  double cone_tilt = 0.0;         // rad about y, pivot at z = 15
  double cylinder_tilt = 0.0;     // rad about x, pivot at the origin
  double half_angle_error = 0.0;  // rad
};

inline ImplicitBody part(const Flaws& flaws = {}, const Pose& workpiece_from_body = {}) {
  const auto depth = [flaws](const Vec3& x) {
    const auto rho = [](const Vec3& p) { return std::hypot(p.x(), p.y()); };
    const double base = std::max({x.z(), rho(x) - 60.0, -20.0 - x.z()});
    const Vec3 c = rotation_x(-flaws.cylinder_tilt) * x;
    const double cylinder = std::max({rho(c) - 25.0, x.z() - 15.0, -1.0 - x.z()});
    const Vec3 k = rotation_y(-flaws.cone_tilt) * (x - Vec3(flaws.cone_shift, 0, 15));
    const double angle = kHalfAngle + flaws.half_angle_error;
    const double surface = (rho(k) - 22.0) * std::cos(angle) + k.z() * std::sin(angle) -
                           flaws.lobe * std::cos(3.0 * std::atan2(k.y(), k.x()));
    const double cone = std::max({surface, x.z() - 30.0, 14.0 - x.z()});
    const double groove = std::max({std::abs(x.x() - 45.0) - 5.0, -8.0 - x.z()});
    return std::max(std::min({base, cylinder, cone}), -groove);
  };
  return {depth, workpiece_from_body};
}

inline InspectionPlan plan() {
  InspectionPlan p;
  p.title = "Small cone test piece";
  p.datum = DatumSystem{"A", "C", "groove"};
  PlannedFeature a;
  a.name = "A";
  a.strategy = RingStrategy{{32.0, 36.0}, 12};
  a.extent = RadialExtent{26.0, 60.0};
  PlannedFeature c;
  c.name = "C";
  c.kind = FeatureKind::cylinder;
  c.radius = 25.0;
  c.strategy = SectionStrategy{{4.0, 8.0, 12.0}, 36};
  c.extent = AxialExtent{0.0, 15.0};
  PlannedFeature groove;
  groove.name = "groove";
  groove.point = {40.0, 0.0, -4.0};
  groove.axis = Vec3::UnitX();
  groove.strategy = GridStrategy{{0, 30, 0}, {0, 0, 3}, 4, 2};
  groove.extent = RectangleExtent{{0, 80, 0}, {0, 0, 8}};
  PlannedFeature cone;
  cone.name = "cone";
  cone.kind = FeatureKind::cone;
  cone.point = {0, 0, 15};
  cone.axis = {0, 0, -1};
  cone.radius = 22.0;
  cone.half_angle = kHalfAngle;
  cone.strategy = SectionStrategy{{-11.0, -7.0, -3.0}, 72};
  cone.extent = AxialExtent{-15.0, 0.0};
  p.features = {a, c, groove, cone};
  using K = CharacteristicKind;
  p.characteristics = {
      {"cone.equivalent_form", K::equivalent_cone_form, {"cone"}, {1}, 0.008},
      {"cone.form", K::cone_form, {"cone"}, {}, 0.008},
      {"cone.half_angle", K::half_angle, {"cone"}, {}, 600e-6},
      {"cone.roundness", K::roundness, {"cone"}, {0}, 0.008},
      {"cone.concentricity", K::concentricity, {"cone"}, {0, 2}, 0.01},
      {"cylinder.roundness", K::roundness, {"C"}, {1}, 0.008},
      {"cylinder.cylindricity", K::cylindricity, {"C"}, {}, 0.008},
      {"cylinder.squareness", K::perpendicularity, {"C", "A"}, {}, 0.01},
      {"cone.to_cylinder", K::concentricity, {"C", "cone"}, {0, 0}, 0.01},
      {"A.flatness", K::flatness, {"A"}, {}, 0.005},
      {"cylinder.diameter", K::diameter, {"C"}, {}, 0.02},
      {"cone.radius", K::radius, {"cone"}, {}, 0.02},
      {"groove.squareness", K::perpendicularity, {"groove", "A"}, {}, 0.02},
  };
  return p;
}

}  // namespace frustum::metrology::test_part
