// Decompositions of matrices of any size, compiled once for all rooms: their templates are the most
// costly to compile that the house uses.
//
// Model    : plain functions over Eigen's decompositions, which say how each is computed
// Units    : none
// Shape    : matrices of dynamic size; small ones whose size the compiler knows stay with Eigen
// Errors   : none; what does not converge says so in `converged`, what has no solution is not
//            finite
// Accuracy : rounding, times the condition where equations are solved
// Source   : Golub, Van Loan, Matrix Computations, chapters 3, 5 and 8
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

namespace frustum {

// Of a symmetric matrix, of which the lower triangle is read.
struct SymmetricEigen {
  Eigen::VectorXd values{};   // ascending
  Eigen::MatrixXd vectors{};  // columns, orthonormal
  bool converged = false;
};
[[nodiscard]] SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& matrix);
[[nodiscard]] Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

enum class SingularVectors { none, thin, full_left, full_right };
struct SingularValues {
  Eigen::VectorXd values{};  // descending
  Eigen::MatrixXd left{};    // columns; empty where not asked for
  Eigen::MatrixXd right{};
  bool converged = false;
};
// Two-sided Jacobi rotations.
[[nodiscard]] SingularValues singular_values(const Eigen::MatrixXd& matrix,
                                             SingularVectors vectors = SingularVectors::none);

// The span of the columns by Householder reflections, as many columns.
[[nodiscard]] Eigen::MatrixXd orthonormal_columns(const Eigen::MatrixXd& matrix);
// What the matrix maps to zero, by full pivoting: no columns where there is nothing.
[[nodiscard]] Eigen::MatrixXd null_space(const Eigen::MatrixXd& matrix, double threshold);
// Rank by column pivoting.
[[nodiscard]] Eigen::Index column_rank(const Eigen::MatrixXd& matrix, double threshold);

// Of a square matrix, by full pivoting.
[[nodiscard]] Eigen::VectorXd solution_of(const Eigen::MatrixXd& square,
                                          const Eigen::VectorXd& right);
// Least squares by column pivoting.
[[nodiscard]] Eigen::VectorXd least_squares_solution(const Eigen::MatrixXd& rows,
                                                     const Eigen::VectorXd& right);
// Of all least-squares solutions the shortest, by a complete orthogonal decomposition. Pivots below
// the threshold, relative to the largest, count as zero.
[[nodiscard]] Eigen::VectorXd shortest_solution(const Eigen::MatrixXd& rows,
                                                const Eigen::VectorXd& right,
                                                std::optional<double> threshold = std::nullopt);

// R of matrix * P = Q R, square (zero below where there are fewer rows), and P as a matrix.
struct PivotedTriangle {
  Eigen::MatrixXd triangle{};
  Eigen::PermutationMatrix<Eigen::Dynamic> columns{};
};
[[nodiscard]] PivotedTriangle pivoted_triangle(const Eigen::MatrixXd& matrix);

// Of a square matrix, by partial pivoting.
[[nodiscard]] Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& square);
// L with L L^T = matrix (symmetric, positive definite; the lower triangle is read).
[[nodiscard]] Eigen::MatrixXd lower_root(const Eigen::MatrixXd& matrix);
// Of a lower triangular matrix.
[[nodiscard]] Eigen::MatrixXd lower_inverse(const Eigen::MatrixXd& lower);

// L D L^T of a symmetric matrix, of which the lower triangle is read, kept for several right-hand
// sides.
class SymmetricFactors {
 public:
  explicit SymmetricFactors(const Eigen::MatrixXd& matrix);
  ~SymmetricFactors();
  SymmetricFactors(SymmetricFactors&&) noexcept;
  SymmetricFactors& operator=(SymmetricFactors&&) noexcept;

  [[nodiscard]] Eigen::VectorXd pivots() const;
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const;
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

}  // namespace frustum
