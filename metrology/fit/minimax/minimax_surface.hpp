// Distances from an element as a smooth function of seven numbers, for solvers that move it in
// small steps.
//
// Model    : in a frame whose z axis is about the element's, parameters (x, y, z of the point;
//            tilts a, b; radius r; angle or ring radius q) with n = (a, b, 1) / |(a, b, 1)| and w =
//            p - (x, y, z):
//              plane      w.n - r
//              sphere     |w| - r
//              straight   |w - (w.n) n| cos q - (w.n) sin q - r   (line, circle, cylinder, cone)
//              ring       distance from the circle of radius q about n, less r   (torus)
//            What an element lacks is a parameter that stays
// Units    : local frame of size one, rad
// Shape    : one row a point
// Errors   : none; on the axis, where distances have no slope, a slope of zero is returned
// Accuracy : rounding of doubles
// Source   : ours
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/pose.hpp"

namespace frustum::metrology {

enum class Surface { plane, sphere, straight, ring };

inline constexpr int kSurfaceParameters = 7;
using SurfaceParameters = Eigen::Matrix<double, kSurfaceParameters, 1>;
namespace surface_parameter {
inline constexpr int kX = 0;
inline constexpr int kY = 1;
inline constexpr int kZ = 2;
inline constexpr int kTiltX = 3;
inline constexpr int kTiltY = 4;
inline constexpr int kRadius = 5;
inline constexpr int kShape = 6;  // half angle of a cone, radius of a torus
}  // namespace surface_parameter

using SurfaceSlopes = Eigen::Matrix<double, Eigen::Dynamic, kSurfaceParameters, Eigen::RowMajor>;

[[nodiscard]] double distance(Surface surface, const SurfaceParameters& at, const Vec3& point);
[[nodiscard]] Eigen::VectorXd distances(Surface surface, const SurfaceParameters& at,
                                        std::span<const Vec3> points);
// One row a point: the derivatives of its distance by the parameters.
[[nodiscard]] SurfaceSlopes slopes(Surface surface, const SurfaceParameters& at,
                                   std::span<const Vec3> points);
// Directions in which parameters move together, one a column.
using SurfaceSteps = Eigen::Matrix<double, kSurfaceParameters, Eigen::Dynamic, 0,
                                   kSurfaceParameters, kSurfaceParameters>;
using SurfaceCurvature = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0,
                                       kSurfaceParameters, kSurfaceParameters>;
// Second derivatives of the distance of one point along the steps.
[[nodiscard]] SurfaceCurvature curvature(Surface surface, const SurfaceParameters& at,
                                         const Vec3& point, const SurfaceSteps& steps);

[[nodiscard]] Vec3 axis_direction(const SurfaceParameters& at);

}  // namespace frustum::metrology
