// The normal of the total-least-squares plane through points: first half of a plane or circle fit.
//
// Model    : direction of least spread of the centred points
// Units    : local frame of size one
// Shape    : at least three points
// Errors   : points on one straight line; points without a preferred plane
// Accuracy : rounding of the points
// Source   : Shakarji 1998, section 3.2
#pragma once

#include <string_view>

#include "core/result.hpp"
#include "metrology/normalised_points.hpp"

namespace frustum::metrology {

// `what` names the element that needs the plane.
[[nodiscard]] Result<UnitVec3> plane_normal(const NormalisedPoints& local, std::string_view what);

}  // namespace frustum::metrology
