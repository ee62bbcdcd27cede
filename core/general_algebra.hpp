// Decompositions of matrices without symmetry, compiled once for all rooms, as linear_algebra.hpp.
//
// Model    : plain functions over Eigen's decompositions, which say how each is computed
// Units    : none
// Shape    : square matrices of dynamic size
// Errors   : none; what does not converge says so in `converged`, what has no solution is not
//            finite
// Accuracy : rounding, times the condition of the eigenvalues or of the equations
// Source   : Golub, Van Loan, Matrix Computations, chapters 3 and 7; Higham 2005, SIAM J. Matrix
//            Anal. Appl. 26(4): scaling and squaring with Pade approximants
#pragma once

#include <Eigen/Core>

namespace frustum {

struct GeneralEigen {
  Eigen::VectorXcd values{};
  Eigen::MatrixXcd vectors{};  // columns of length 1; empty where not asked for
  bool converged = false;
};
[[nodiscard]] GeneralEigen general_eigen(const Eigen::MatrixXd& matrix, bool with_vectors);

// By partial pivoting, as many columns as the right-hand side has.
[[nodiscard]] Eigen::MatrixXcd complex_solution(const Eigen::MatrixXcd& square,
                                                const Eigen::MatrixXcd& right);

[[nodiscard]] Eigen::MatrixXd matrix_exponential(const Eigen::MatrixXd& matrix);

}  // namespace frustum
