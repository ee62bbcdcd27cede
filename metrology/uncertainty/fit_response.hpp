// How a fitted element answers the error of each of its points.
//
// Model    : the points' errors e along their outward normals change the parameters of a least-
//            squares fit by -(J^T J)^-1 J^T e, J = d residual / d parameter
// Units    : mm, rad
// Shape    : planes, single touches, circles (within their plane), spheres (lift and shifts are
//            those of the centre along z, x, y), cylinders and cones; one row of weights a
//            parameter, one column a point
// Errors   : none: what was fitted tells its parameters
// Accuracy : 1e-7 of the weights for points near the element
// Source   : Shakarji 1998, section 4 (the parameters)
#pragma once

#include <Eigen/Core>
#include <vector>

#include "metrology/characteristic/fitted_feature.hpp"

namespace frustum::metrology {

// Directions u, v are tangents(axis).
enum class ElementChange { lift, shift_u, shift_v, tilt_u, tilt_v, radius, half_angle };

// The element with one parameter changed `by` so many mm or rad.
[[nodiscard]] Element varied(Element element, ElementChange change, double by);
// The feature with its element changed so, its points moved along with it.
[[nodiscard]] FittedFeature varied(const FittedFeature& feature, ElementChange change, double by);
// Half the step of a central difference in that parameter, mm or rad.
[[nodiscard]] double step_of(ElementChange change);

struct FitResponse {
  std::vector<ElementChange> changes{};
  Eigen::MatrixXd weights{};
};
[[nodiscard]] FitResponse fit_response(const FittedFeature& feature);

}  // namespace frustum::metrology
