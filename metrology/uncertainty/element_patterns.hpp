// How the points of a feature move when its element does.
//
// Model    : a small change of the element (a plane lifts or tilts; an axis shifts or tilts, a
//            radius or a half angle grows; a line of a surface shifts or turns within its plane)
//            moves each point along its outward normal; the patterns span all of these motions and
//            are orthonormal, so that independent errors of the points have independent
//            coefficients
// Units    : of unit length
// Shape    : a row a point, a column a pattern; circles within their plane
// Errors   : none: what was fitted tells its parameters
// Accuracy : 1e-7 for points near the element
// Source   : Shakarji 1998, section 4 (the parameters)
#pragma once

#include <Eigen/Core>

#include "metrology/characteristic/fitted_feature.hpp"

namespace frustum::metrology {

[[nodiscard]] Eigen::MatrixXd element_patterns(const FittedFeature& feature);

}  // namespace frustum::metrology
