// Where a plan wants to touch a feature.
//
// Model    : points on the nominal surface with the nominal normal out of the material
// Units    : mm, rad; workpiece frame of the plan
// Shape    : sections in order, points of a section in order
// Errors   : none for a plan that check() accepts
// Accuracy : rounding of doubles
// Source   : ours
#pragma once

#include <vector>

#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

struct PlannedPoint {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  // unit, out of the material
  std::size_t section = 0;
  bool scanned = false;
};
[[nodiscard]] std::vector<PlannedPoint> planned_points(const PlannedFeature& feature);
[[nodiscard]] std::size_t section_count(const PlannedFeature& feature);

// Radius across the axis of a cylinder, cone, circle or sphere, `along` mm from its point.
[[nodiscard]] double section_radius(const PlannedFeature& feature, double along);
// mm; on its larger end all the way.
[[nodiscard]] double spiral_length(const PlannedFeature& feature, const SpiralStrategy& s);

// Unit vector perpendicular to the axis where angles about it start.
[[nodiscard]] Vec3 zero_direction(const PlannedFeature& feature);

// Range along the axis that the feature covers: its extent, or the range of its strategy.
[[nodiscard]] AxialExtent axial_extent(const PlannedFeature& feature);

// The planned section nearest to a point: by its place along the axis, or its radius on a plane.
[[nodiscard]] std::size_t nearest_section(const PlannedFeature& feature, const Vec3& point);

}  // namespace frustum::metrology
