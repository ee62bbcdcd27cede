// Trigonometric polynomials at thousands of angles, from what they are at a few.
//
// Model    : f(t) = a + sum over k <= 3 of b_k cos kt + c_k sin kt. f is evaluated at seven of the
//            angles, solved for, and evaluated at five more, which decide whether it is one
// Units    : rad; those of f
// Shape    : angles x columns
// Errors   : nothing where the angles are too few to be worth it, or where f is no such polynomial
// Accuracy : 1e-11 of the largest value of a column, at the five angles
// Source   : nominal and actual positions of a chain of revolute and prismatic joints with constant
//            errors are such polynomials of one of its angles
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace frustum::instruments {

class AnglePolynomials {
 public:
  explicit AnglePolynomials(std::span<const double> angles);

  // `values(i)`: f at the i-th angle. Coefficients of f, of which basis() makes its values.
  [[nodiscard]] std::optional<Eigen::MatrixXd> coefficients(
      Eigen::Index columns, const std::function<Eigen::RowVectorXd(std::size_t)>& values) const;
  [[nodiscard]] const Eigen::MatrixXd& basis() const { return basis_; }
  // The values themselves.
  [[nodiscard]] std::optional<Eigen::MatrixXd> at_all(
      Eigen::Index columns, const std::function<Eigen::RowVectorXd(std::size_t)>& values) const;

 private:
  Eigen::MatrixXd basis_{};  // at each angle; empty where not worth it
  std::vector<std::size_t> nodes_{}, checks_{};
};

}  // namespace frustum::instruments
