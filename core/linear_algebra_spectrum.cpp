// Eigenvalues and singular values: by themselves, since they take as long to compile as all others.
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "core/linear_algebra.hpp"

namespace frustum {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

unsigned options_for(SingularVectors vectors) {
  switch (vectors) {
    case SingularVectors::none:
      break;
    case SingularVectors::thin:
      return Eigen::ComputeThinU | Eigen::ComputeThinV;
    case SingularVectors::full_left:
      return Eigen::ComputeFullU;
    case SingularVectors::full_right:
      return Eigen::ComputeFullV;
  }
  return 0;
}

}  // namespace

SymmetricEigen symmetric_eigen(const MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(matrix);
  return {eigen.eigenvalues(), eigen.eigenvectors(), eigen.info() == Eigen::Success};
}

VectorXd symmetric_eigenvalues(const MatrixXd& matrix) {
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues();
}

SingularValues singular_values(const MatrixXd& matrix, SingularVectors vectors) {
  const Eigen::JacobiSVD<MatrixXd> svd(matrix, options_for(vectors));
  SingularValues found{svd.singularValues(), {}, {}, svd.info() == Eigen::Success};
  if (svd.computeU()) found.left = svd.matrixU();
  if (svd.computeV()) found.right = svd.matrixV();
  return found;
}

}  // namespace frustum
