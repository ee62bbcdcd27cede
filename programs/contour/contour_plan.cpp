// What is measured of a contouring piece.
#include <fmt/format.h>

#include <algorithm>

#include "programs/contour/contour_piece.hpp"

namespace frustum::programs {
namespace {

using metrology::CharacteristicKind;
using metrology::FeatureKind;
using metrology::LineStrategy;
using metrology::PlannedCharacteristic;
using metrology::PlannedFeature;
using metrology::SectionStrategy;

constexpr double kOffCorner = 5.0;  // mm
constexpr int kSidePoints = 49;
constexpr int kCirclePoints = 360;

class ContourPlan {
 public:
  ContourPlan(const ContourPiece& piece, const ContourGeometry& shape) : piece_(piece) {
    plan_.title = fmt::format("Contouring piece of {:g} mm, own dimensions", piece.size.value);
    plan_.alignment = metrology::Alignment::plan;
    // Goes half way down each level without touching the ledge.
    plan_.probe.ball_diameter = std::min(3.0, 0.5 * shape.level);
    add_circle("circle", shape.circle_radius, shape.middle(0), metrology::Side::outside);
    for (std::size_t i = 0; i < shape.polygons.size(); ++i) {
      add_polygon(shape.polygons[i], shape.middle(i + 1));
    }
    if (piece.bore) {
      add_circle("bore", shape.bore_radius, shape.middle(1), metrology::Side::inside);
    }
  }
  [[nodiscard]] metrology::InspectionPlan plan() && { return std::move(plan_); }

 private:
  void add(PlannedCharacteristic characteristic) {
    characteristic.tolerance = metrology::is_angle(characteristic.kind)
                                   ? piece_.angle_tolerance.value
                                   : piece_.tolerance.value;
    plan_.characteristics.push_back(std::move(characteristic));
  }

  void add_circle(const std::string& name, double radius, double z, metrology::Side side) {
    constexpr double kStart = 0.5 * kRadPerDeg;
    plan_.features.push_back(
        {.name = name,
         .kind = FeatureKind::circle,
         .point = z * Vec3::UnitZ(),
         .radius = radius,
         .side = side,
         .strategy = SectionStrategy{.points_per_section = kCirclePoints, .start_angle = kStart}});
    add({.name = name + ".roundness", .kind = CharacteristicKind::roundness, .features = {name}});
    add({.name = name + ".diameter",
         .kind = CharacteristicKind::diameter,
         .features = {name},
         .deviation = true});
  }

  void add_polygon(const ContourPolygon& polygon, double z) {
    const std::string name(polygon.name);
    std::vector<std::string> sides;
    for (std::size_t side = 0; side < 4; ++side) {
      sides.push_back(fmt::format("{}.{}", name, side + 1));
      const double reach = 0.5 * polygon.length(side) - kOffCorner;
      plan_.features.push_back(
          {.name = sides.back(),
           .kind = FeatureKind::line,
           .point = 0.5 * (polygon.corner(side) + polygon.corner(side + 1)) + z * Vec3::UnitZ(),
           .axis = polygon.along(side),
           .normal = polygon.normal(side),
           .strategy = LineStrategy{-reach, reach, kSidePoints}});
    }
    // The distance grows along the normal of its second side.
    add({.name = name + ".width_13",
         .kind = CharacteristicKind::line_distance,
         .features = {sides[0], sides[2]},
         .direction = polygon.normal(2)});
    add({.name = name + ".width_24",
         .kind = CharacteristicKind::line_distance,
         .features = {sides[1], sides[3]},
         .direction = polygon.normal(3)});
    // Clockwise, the interior angle grows as the second side turns to the left.
    add({.name = name + ".angle_12",
         .kind = CharacteristicKind::line_angle,
         .features = {sides[0], sides[1]},
         .direction = Vec3::UnitZ()});
    add({.name = name + ".straightness",
         .kind = CharacteristicKind::straightness,
         .features = sides,
         .parameter = metrology::FormParameter::t});
  }

  const ContourPiece& piece_;
  metrology::InspectionPlan plan_{};
};

}  // namespace

metrology::InspectionPlan contour_plan(const ContourPiece& piece, const ContourGeometry& shape) {
  return ContourPlan(piece, shape).plan();
}

}  // namespace frustum::programs
