// The plane of points: the first half of a plane or circle fit, and where lines and circles of
// drawings lie.
//
// Model    : direction of least spread of the centred points, within the constraints
// Units    : local frame of size one
// Shape    : at least three points
// Errors   : points on one straight line; points without a preferred plane
// Accuracy : rounding of the points
// Source   : Shakarji 1998, section 3.2
#pragma once

#include <span>
#include <string_view>

#include "core/result.hpp"
#include "metrology/fit/normalised_points.hpp"

namespace frustum::metrology {

// `what` names the element that needs the plane.
[[nodiscard]] Result<UnitVec3> plane_normal(const NormalisedPoints& local, std::string_view what);

// Normal of the coordinate plane in which the points are constant, z otherwise.
[[nodiscard]] UnitVec3 coordinate_plane(std::span<const Vec3> points);

}  // namespace frustum::metrology
