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

#include "metrology/inspection_plan.hpp"

namespace frustum::metrology {

struct PlannedPoint {
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  // unit, out of the material
  std::size_t section = 0;
};
[[nodiscard]] std::vector<PlannedPoint> planned_points(const PlannedFeature& feature);
[[nodiscard]] std::size_t section_count(const PlannedFeature& feature);

// Unit vector perpendicular to the axis where angles about it start.
[[nodiscard]] Vec3 zero_direction(const PlannedFeature& feature);

// Range along the axis that the feature covers: its extent, or the range of its strategy.
[[nodiscard]] AxialExtent axial_extent(const PlannedFeature& feature);

// The planned section nearest to a point: by its place along the axis, or its radius on a plane.
[[nodiscard]] std::size_t nearest_section(const PlannedFeature& feature, const Vec3& point);

}  // namespace frustum::metrology
