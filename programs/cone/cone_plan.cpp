// What to measure on a cone test piece.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "programs/cone/cone_frustum.hpp"

namespace frustum::programs {
namespace {

using metrology::CharacteristicKind;
using metrology::FeatureKind;
using metrology::GridStrategy;
using metrology::InspectionPlan;
using metrology::PlannedCharacteristic;
using metrology::PlannedFeature;
using metrology::RadialExtent;
using metrology::RingStrategy;
using metrology::SectionStrategy;

constexpr double kEdge = 0.5;  // mm: sections stay this far from an edge of the cone
constexpr double kBallDiameter = 2.0;
constexpr int kRoundPoints = 360;

// Half a step off the approach, so that no point is on the seam of the path.
double off_the_seam() { return 0.5 * 2.0 * std::numbers::pi / kRoundPoints; }

PlannedFeature reference_plane(const ConeGeometry& shape) {
  return {.name = "A",
          .kind = FeatureKind::plane,
          .point = Vec3(0, 0, shape.top_z),
          .axis = Vec3::UnitZ(),
          .strategy = RingStrategy{{0.4 * shape.top_radius, 0.8 * shape.top_radius}, 12},
          .extent = RadialExtent{0.0, shape.top_radius}};
}

PlannedFeature reference_cylinder(const ConeGeometry& shape) {
  const double height = shape.groove_floor_z - shape.bottom_z;
  return {.name = "C",
          .kind = FeatureKind::cylinder,
          .point = Vec3(0, 0, shape.bottom_z),
          .axis = Vec3::UnitZ(),
          .radius = shape.blank_radius,
          .strategy = SectionStrategy{{0.25 * height, 0.75 * height}, 24},
          .extent = metrology::AxialExtent{0.0, shape.floor_z - shape.bottom_z}};
}

PlannedFeature groove_face(const ConeGeometry& shape) {
  const double outer = shape.blank_radius, inner = shape.groove_inner_y;
  const double depth = shape.floor_z - shape.groove_floor_z;
  const double z = shape.floor_z - 0.5 * depth;
  return {
      .name = "groove",
      .kind = FeatureKind::plane,
      .point = Vec3(-shape.cutter_radius, 0.5 * (outer + inner), z),
      .axis = Vec3::UnitX(),
      .strategy = GridStrategy{Vec3(0, 0.7 * (outer - inner), 0), Vec3(0, 0, 0.25 * depth), 5, 2},
      .extent = metrology::RectangleExtent{Vec3(0, outer - inner, 0), Vec3(0, 0, depth)}};
}

PlannedFeature cone_feature(const ConeFrustum& cone, const ConeGeometry& shape) {
  const double height = shape.top_z - shape.base_z;
  // Distances along the axis towards growing radius: from the base upwards they are negative. The
  // first section is the one nearest the tool tip.
  return {
      .name = "cone",
      .kind = FeatureKind::cone,
      .point = Vec3(0, 0, shape.base_z),
      .axis = -Vec3::UnitZ(),
      .radius = shape.base_radius,
      .half_angle = cone.cone_angle.value,
      .zero = Vec3::UnitX(),
      .strategy =
          SectionStrategy{{-kEdge, -0.5 * height, kEdge - height}, kRoundPoints, off_the_seam()},
      .extent = metrology::AxialExtent{-height, 0.0}};
}

PlannedFeature cylinder_feature(const ConeGeometry& shape) {
  const double height = shape.base_z - shape.floor_z;
  // The ball must clear the flange below and the cone's edge above.
  const double lowest = 0.5 * kBallDiameter + kEdge;
  return {
      .name = "cylinder",
      .kind = FeatureKind::cylinder,
      .point = Vec3(0, 0, shape.floor_z),
      .axis = Vec3::UnitZ(),
      .radius = shape.base_radius,
      .zero = Vec3::UnitX(),
      .strategy = SectionStrategy{{lowest, 0.5 * (lowest + height - kEdge), height - 2.0 * kEdge},
                                  kRoundPoints,
                                  off_the_seam()},
      .extent = metrology::AxialExtent{0.0, height}};
}

PlannedFeature flange_face(const ConeGeometry& shape) {
  const double inner = shape.base_radius, outer = shape.blank_radius;
  return {.name = "flange",
          .kind = FeatureKind::plane,
          .point = Vec3(0, 0, shape.floor_z),
          .axis = Vec3::UnitZ(),
          .strategy = RingStrategy{{inner + 0.3 * (outer - inner), inner + 0.8 * (outer - inner)},
                                   12,
                                   15.0 * kRadPerDeg},
          .extent = RadialExtent{inner, outer}};
}

// The nearest multiple, so that a file says 10 um and not 10.000000000000002 um.
double nearest(double value, double step) {
  const double per_step = std::round(1.0 / step);
  return std::round(value * per_step) / per_step;
}

}  // namespace

InspectionPlan cone_plan(const ConeFrustum& cone, const ConeGeometry& shape) {
  const double share = cone.limits == ConeLimits::tenth ? 0.1 : 1.0;
  const double form = nearest(0.1 * share, 1e-6);      // mm: roundness, concentricity of NAS 979
  const double angular = nearest(6e-4 * share, 1e-9);  // rad: angular accuracy, 600 um/m
  const double height = shape.top_z - shape.base_z;

  InspectionPlan plan;
  plan.title = cone.limits == ConeLimits::tenth ? "Cone frustum, a tenth of the NAS 979 limits"
                                                : "Cone frustum, NAS 979 limits";
  plan.probe = {.ball_diameter = kBallDiameter, .clearance = 2.0, .reach = 2.0};
  plan.datum = metrology::DatumSystem{"A", "C", "groove"};
  plan.features = {reference_plane(shape),    reference_cylinder(shape), groove_face(shape),
                   cone_feature(cone, shape), cylinder_feature(shape),   flange_face(shape)};
  const auto add = [&plan](const char* name, CharacteristicKind kind,
                           std::vector<std::string> features, std::vector<std::size_t> sections,
                           double tolerance) {
    plan.characteristics.push_back(
        {name, kind, std::move(features), std::move(sections), tolerance});
  };
  add("cone.equivalent_form", CharacteristicKind::equivalent_cone_form, {"cone"}, {0}, form);
  add("cone.form", CharacteristicKind::cone_form, {"cone"}, {}, form);
  add("cone.roundness", CharacteristicKind::roundness, {"cone"}, {0}, form);
  add("cone.half_angle", CharacteristicKind::half_angle, {"cone"}, {}, angular);
  add("cone.concentricity", CharacteristicKind::concentricity, {"cone"}, {0, 2}, form);
  add("cylinder.roundness", CharacteristicKind::roundness, {"cylinder"}, {1}, form);
  add("cylinder.cylindricity", CharacteristicKind::cylindricity, {"cylinder"}, {}, form);
  // 600 um/m over the height of the cone and the cylinder.
  add("cylinder.perpendicularity", CharacteristicKind::perpendicularity, {"cylinder", "A"}, {},
      nearest(std::max(0.1 * form, angular * (height + shape.base_z - shape.floor_z)), 1e-6));
  return plan;
}

}  // namespace frustum::programs
