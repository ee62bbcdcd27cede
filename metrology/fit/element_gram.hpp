// Normal equations of an element and all its points in one pass.
//
// Model  : products of the columns of the Jacobian and, last, of the residuals, with the weights
// Units  : local frame of size one (normalised_points.hpp)
// Shape  : lower triangle of a square of one more than the parameters; no allocation
// Errors : none
#pragma once

#include "metrology/fit/element_model.hpp"
#include "metrology/fit/point_blocks.hpp"

namespace frustum::metrology {

using ElementGram = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostParameters + 1,
                                  kMostParameters + 1>;
[[nodiscard]] ElementGram gram_of(const Element& element, const PointBlocks& points);

// Sum of the weighted squares.
[[nodiscard]] inline double cost_of(const ElementGram& gram) {
  return gram(gram.rows() - 1, gram.cols() - 1);
}

}  // namespace frustum::metrology
