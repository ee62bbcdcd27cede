// Correlation matrices.
//
// Model    : the lower triangle L of a correlation R = L L^T; Pearson's coefficient of samples
// Units    : none
// Errors   : a matrix that is not square of the given size, not symmetric, without ones on its
//            diagonal, or not positive definite, with its smallest eigenvalue
// Accuracy : rounding
// Source   : Golub, Van Loan, Matrix Computations, section 4.2
#pragma once

#include <Eigen/Core>
#include <span>

#include "core/result.hpp"

namespace frustum::studies {

[[nodiscard]] Result<Eigen::MatrixXd> cholesky_of(const Eigen::MatrixXd& correlation,
                                                  std::size_t size);
// Of two samples of the same size; 0 where one does not vary.
[[nodiscard]] double pearson(std::span<const double> x, std::span<const double> y);

}  // namespace frustum::studies
