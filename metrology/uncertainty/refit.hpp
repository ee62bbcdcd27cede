// A feature whose points moved a little, fitted again from where its element is.
//
// Model    : least squares as fit_feature(). Cylinders and cones start from the known element, so a
//            refit costs a few steps instead of a search; the other elements have no search
// Units    : mm, rad
// Shape    : the points of the feature, in their order; moved by far less than the radius
// Errors   : those of fit_feature(), which takes over where the steps do not settle
// Accuracy : 1e-9 mm beside fit_feature() (tests/metrology/monte_carlo_test.cpp); the cofactor
//            stays that of the known feature
// Source   : Shakarji 1998, section 4 (the parameters)
#pragma once

#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"

namespace frustum::metrology {

// `points` are surface points.
[[nodiscard]] Result<FittedFeature> refit(const FittedFeature& known,
                                          const std::vector<Vec3>& points);

}  // namespace frustum::metrology
