#include "core/linear_algebra.hpp"

#include <gtest/gtest.h>

namespace frustum {
namespace {

Eigen::MatrixXd tall() {
  Eigen::MatrixXd rows(4, 3);
  rows << 1, 2, 3, 0, 1, 4, 5, 6, 0, 2, 2, 1;
  return rows;
}

TEST(LinearAlgebra, TakesASymmetricMatrixApart) {
  const Eigen::MatrixXd square = tall().transpose() * tall();
  const SymmetricEigen eigen = symmetric_eigen(square);
  EXPECT_TRUE(eigen.converged);
  EXPECT_TRUE(
      (eigen.vectors * eigen.values.asDiagonal() * eigen.vectors.transpose()).isApprox(square));
  EXPECT_TRUE(symmetric_eigenvalues(square).isApprox(eigen.values));
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(3, 1.0, 3.0);
  const SymmetricFactors factors(square);
  EXPECT_TRUE((square * factors.solve(right)).isApprox(right));
  EXPECT_GT(factors.pivots().minCoeff(), 0.0);
}

TEST(LinearAlgebra, SingularVectorsMakeTheMatrixAgain) {
  const SingularValues thin = singular_values(tall(), SingularVectors::thin);
  EXPECT_TRUE(thin.converged);
  EXPECT_TRUE((thin.left * thin.values.asDiagonal() * thin.right.transpose()).isApprox(tall()));
  EXPECT_EQ(singular_values(tall()).left.size(), 0);
  EXPECT_EQ(singular_values(tall(), SingularVectors::full_left).left.cols(), 4);
  EXPECT_EQ(singular_values(tall().transpose(), SingularVectors::full_right).right.cols(), 4);
}

TEST(LinearAlgebra, FindsSpanAndNullSpace) {
  const Eigen::MatrixXd span = orthonormal_columns(tall());
  EXPECT_TRUE((span.transpose() * span).isIdentity(1e-12));
  EXPECT_TRUE((span * span.transpose() * tall()).isApprox(tall()));
  const Eigen::MatrixXd kernel = null_space(tall().transpose(), 1e-9);
  ASSERT_EQ(kernel.cols(), 1);
  EXPECT_LT((tall().transpose() * kernel).norm(), 1e-12);
  EXPECT_EQ(null_space(tall(), 1e-9).cols(), 0);
  EXPECT_EQ(column_rank(tall(), 1e-9), 3);
  EXPECT_EQ(column_rank(tall().transpose(), 1e-9), 3);
  const PivotedTriangle factors = pivoted_triangle(tall());
  EXPECT_TRUE((factors.triangle.transpose() * factors.triangle)
                  .isApprox((tall() * factors.columns).transpose() * (tall() * factors.columns)));
}

TEST(LinearAlgebra, SolvesEquations) {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(3, -1.0, 2.0);
  const Eigen::MatrixXd square = tall().topRows(3);
  EXPECT_TRUE(solution_of(square, square * x).isApprox(x));
  EXPECT_TRUE(least_squares_solution(tall(), tall() * x).isApprox(x));
  // Of a wide system the shortest solution has no part in the null space.
  const Eigen::MatrixXd wide = tall().transpose();
  const Eigen::VectorXd shortest = shortest_solution(wide, x);
  EXPECT_TRUE((wide * shortest).isApprox(x));
  EXPECT_LT((null_space(wide, 1e-9).transpose() * shortest).norm(), 1e-12);
}

}  // namespace
}  // namespace frustum
