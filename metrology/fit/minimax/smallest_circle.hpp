// The smallest circle that holds points of a plane.
//
// Model    : one of the circles that two points span as a diameter or three points are on
// Units    : mm
// Shape    : any number of points; the time grows with the cube of their number at worst
// Errors   : none; no points give 0
// Accuracy : 1e-12 of the radius
// Source   : incremental construction (Welzl 1991) in the order of the points
#pragma once

#include <Eigen/Core>
#include <span>

namespace frustum::metrology {

struct SmallestCircle {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.0;
};
[[nodiscard]] SmallestCircle smallest_circle(std::span<const Eigen::Vector2d> points);

}  // namespace frustum::metrology
