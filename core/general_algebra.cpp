#include "core/general_algebra.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <unsupported/Eigen/MatrixFunctions>

namespace frustum {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

GeneralEigen general_eigen(const MatrixXd& matrix, bool with_vectors) {
  const Eigen::EigenSolver<MatrixXd> eigen(matrix, with_vectors);
  GeneralEigen found{eigen.eigenvalues(), {}, eigen.info() == Eigen::Success};
  if (with_vectors && found.converged) found.vectors = eigen.eigenvectors();
  return found;
}

MatrixXcd complex_solution(const MatrixXcd& square, const MatrixXcd& right) {
  return Eigen::PartialPivLU<MatrixXcd>(square).solve(right);
}

MatrixXd matrix_exponential(const MatrixXd& matrix) { return matrix.exp(); }

}  // namespace frustum
