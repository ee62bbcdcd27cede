#include "core/linear_algebra.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>

namespace frustum {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

MatrixXd orthonormal_columns(const MatrixXd& matrix) {
  return Eigen::HouseholderQR<MatrixXd>(matrix).householderQ() *
         MatrixXd::Identity(matrix.rows(), matrix.cols());
}

MatrixXd null_space(const MatrixXd& matrix, double threshold) {
  Eigen::FullPivLU<MatrixXd> lu(matrix);
  lu.setThreshold(threshold);
  if (lu.dimensionOfKernel() == 0) return MatrixXd(matrix.cols(), 0);
  return lu.kernel();
}

Eigen::Index column_rank(const MatrixXd& matrix, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(matrix);
  qr.setThreshold(threshold);
  return qr.rank();
}

VectorXd solution_of(const MatrixXd& square, const VectorXd& right) {
  return Eigen::FullPivLU<MatrixXd>(square).solve(right);
}

VectorXd least_squares_solution(const MatrixXd& rows, const VectorXd& right) {
  return Eigen::ColPivHouseholderQR<MatrixXd>(rows).solve(right);
}

VectorXd shortest_solution(const MatrixXd& rows, const VectorXd& right,
                           std::optional<double> threshold) {
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
  if (threshold) solver.setThreshold(*threshold);
  solver.compute(rows);
  return solver.solve(right);
}

PivotedTriangle pivoted_triangle(const MatrixXd& matrix) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(matrix);
  const Eigen::Index n = matrix.cols();
  const Eigen::Index filled = std::min(n, matrix.rows());
  MatrixXd triangle = MatrixXd::Zero(n, n);
  triangle.topRows(filled) = qr.matrixR().topRows(filled);
  return {triangle.triangularView<Eigen::Upper>(), qr.colsPermutation()};
}

MatrixXd inverse_of(const MatrixXd& square) {
  return Eigen::PartialPivLU<MatrixXd>(square).inverse();
}

MatrixXd lower_root(const MatrixXd& matrix) { return Eigen::LLT<MatrixXd>(matrix).matrixL(); }

MatrixXd lower_inverse(const MatrixXd& lower) {
  return lower.triangularView<Eigen::Lower>().solve(MatrixXd::Identity(lower.rows(), lower.cols()));
}

struct SymmetricFactors::Factors {
  Eigen::LDLT<MatrixXd> ldlt;
};

SymmetricFactors::SymmetricFactors(const MatrixXd& matrix)
    : factors_(std::make_unique<const Factors>(Factors{Eigen::LDLT<MatrixXd>(matrix)})) {}
SymmetricFactors::~SymmetricFactors() = default;
SymmetricFactors::SymmetricFactors(SymmetricFactors&&) noexcept = default;
SymmetricFactors& SymmetricFactors::operator=(SymmetricFactors&&) noexcept = default;

VectorXd SymmetricFactors::pivots() const { return factors_->ldlt.vectorD(); }
VectorXd SymmetricFactors::solve(const VectorXd& right) const {
  return factors_->ldlt.solve(right);
}
MatrixXd SymmetricFactors::solve(const MatrixXd& right) const {
  return factors_->ldlt.solve(right);
}

}  // namespace frustum
