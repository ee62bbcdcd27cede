// A small block with steps and chamfers as exact planes, and the plan that measures it as a step
// machining pattern.
//
// Along X, 60 mm long; seen from the side, going up: floors F_a, F_b (z = 0, y = -45 and 45), walls
// S_a, S_b (y = -40 and 40), floors B_c, B_d (z = 5), walls S_c, S_d (y = -30 and 30), chamfers
// E_c, E_d of 45 deg (y = -20 and 20 at z = 12).
// Units: mm, rad.
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "metrology/cmm.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "metrology/plan/strategy.hpp"
#include "metrology/probing/surface_probe.hpp"

namespace frustum::metrology::step_part {

struct Face {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();

  // `by` mm outward.
  [[nodiscard]] Face shifted(double by) const { return {point + by * normal, normal}; }
  [[nodiscard]] Face turned(const Mat3& rotation, const Vec3& pivot) const {
    return {pivot + rotation * (point - pivot), rotation * normal};
  }
  [[nodiscard]] Face moved(const Pose& by) const { return {by.point(point), by.direction(normal)}; }
};

struct Part {
  std::map<std::string, Face> faces{};

  [[nodiscard]] std::optional<Touch> touch(const Vec3& start, const UnitVec3& direction,
                                           double length_mm) const {
    std::optional<Touch> nearest;
    double best = length_mm;
    for (const auto& [name, face] : faces) {
      const double against = direction.vec().dot(face.normal);
      // Faces that are met at less than 30 deg are not those that the plan approaches.
      if (against > -0.5) continue;
      const double t = (face.point - start).dot(face.normal) / against;
      if (t < 0.0 || t > best) continue;
      // Each face ends before the next one of its kind begins, 70 mm off.
      if (std::abs((start + t * direction.vec() - face.point).y()) > 10.0) continue;
      best = t;
      nearest = Touch{start + t * direction.vec(), face.normal};
    }
    return nearest;
  }

  [[nodiscard]] Part moved(const Pose& by) const {
    Part out = *this;
    for (auto& [name, face] : out.faces) face = face.moved(by);
    return out;
  }
};

inline Part part() {
  const Vec3 up(0, 0, 1);
  const Vec3 left(0, -1, 0);
  const Vec3 right(0, 1, 0);
  return {{{"F_a", {{0, -45, 0}, up}},
           {"F_b", {{0, 45, 0}, up}},
           {"S_a", {{0, -40, 2.5}, left}},
           {"S_b", {{0, 40, 2.5}, right}},
           {"B_c", {{0, -35, 5}, up}},
           {"B_d", {{0, 35, 5}, up}},
           {"S_c", {{0, -30, 7.5}, left}},
           {"S_d", {{0, 30, 7.5}, right}},
           {"E_c", {{0, -20, 12}, (left + up).normalized()}},
           {"E_d", {{0, 20, 12}, (right + up).normalized()}}}};
}

inline InspectionPlan plan() {
  InspectionPlan p;
  p.title = "Step pattern";
  p.alignment = Alignment::plan;
  const Part nominal = part();
  for (const char* name : {"F_a", "F_b"}) {
    PlannedFeature f;
    f.name = name;
    f.point = nominal.faces.at(name).point;
    f.strategy = GridStrategy{{50, 0, 0}, {0, 8, 0}, 5, 3};
    p.features.push_back(f);
  }
  for (const char* name : {"S_a", "S_b", "B_c", "B_d", "S_c", "S_d", "E_c", "E_d"}) {
    PlannedFeature f;
    f.name = name;
    f.kind = FeatureKind::line;
    f.point = nominal.faces.at(name).point;
    f.axis = Vec3::UnitX();
    f.normal = nominal.faces.at(name).normal;
    f.strategy = LineStrategy{-25.0, 25.0, 11};
    p.features.push_back(f);
  }
  p.frames = {{"R", {"F_a", "F_b"}, "S_a"}};
  using K = CharacteristicKind;
  const Vec3 y(0, 1, 0);
  const Vec3 z(0, 0, 1);
  p.characteristics = {
      {"dL", K::line_distance, {"S_c", "S_d"}, {}, 0.02, "R", y},
      {"dH", K::line_distance, {"B_c", "B_d"}, {}, 0.02, "R", z},
      {"theta", K::line_angle, {"S_c", "S_d"}, {}, 200 * 1e-6, "R", z},
      {"phi", K::line_angle, {"B_c", "B_d"}, {}, 200 * 1e-6, "R", y},
      {"dL0", K::line_distance, {"S_a", "S_b"}, {}, 0.02, "R", y},
      {"dE", K::line_distance, {"E_c", "E_d"}, {}, 0.02, "R", y},
  };
  return p;
}

// Points where the approach lines of the plan meet the part, as a probe without ball would see
// them.
inline std::vector<FeaturePoints> surface_points(const InspectionPlan& plan, const Part& part) {
  std::vector<FeaturePoints> all;
  for (const PlannedFeature& feature : plan.features) {
    FeaturePoints points{feature.name, {}, {}};
    const Face& face = part.faces.at(feature.name.substr(0, 3));  // "S_c" of "S_c upright"
    for (const PlannedPoint& p : planned_points(feature)) {
      const double t = (face.point - p.point).dot(face.normal) / p.normal.dot(face.normal);
      points.points.push_back(p.point + t * p.normal);
    }
    all.push_back(std::move(points));
  }
  return all;
}

}  // namespace frustum::metrology::step_part
