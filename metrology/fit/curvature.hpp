// Second derivatives of half the sum of weighted squares by the parameters that constraints leave
// free.
//
// Model    : J^T W J + sum w d d'': differences of the exact gradients at elements 1e-5 to either
//            side, turned into the tangents of the element
// Units    : local frame of size one (normalised_points.hpp), rad
// Shape    : `basis` as allowed_steps() gives it; a symmetric square of its columns, no allocation
// Errors   : none
// Accuracy : 1e-9 for elements of about the size of the part, which no point sits on the axis of
// Source   : ours
#pragma once

#include "metrology/fit/constraint_steps.hpp"
#include "metrology/fit/point_blocks.hpp"

namespace frustum::metrology {

[[nodiscard]] StepBasis curvature_of(const Element& element, const PointBlocks& points,
                                     const StepBasis& basis);

}  // namespace frustum::metrology
