// The axes in which two lines are compared.
//
// Model    : see line_axes
// Units    : none; unit vectors
// Shape    : one characteristic that compares lines
// Errors   : none; nothing where there are no such axes
// Accuracy : rounding
// Source   : ours
#pragma once

#include <optional>

#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

// Unit vectors, right-handed: along x across = height.
struct LineAxes {
  Vec3 along = Vec3::UnitX();
  Vec3 across = Vec3::UnitY();
  Vec3 height = Vec3::UnitZ();
};

// The axes in which a line kind is measured, from the planned direction of its lines: along = that;
// across = `direction` for a distance, direction x along for an angle. Nothing when the direction
// is along the lines.
[[nodiscard]] std::optional<LineAxes> line_axes(CharacteristicKind kind, const Vec3& line,
                                                const Vec3& direction);

// Within what counts as planned parallel: 1e-6 rad. What a program computes is far nearer, what a
// drawing means to be parallel too; more would be a systematic error of a um in a metre.
[[nodiscard]] bool is_parallel(const Vec3& a, const Vec3& b);

}  // namespace frustum::metrology
