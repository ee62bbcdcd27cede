#include "instruments/angle_polynomials.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustum::instruments {
namespace {

constexpr int kDegree = 4;
constexpr Eigen::Index kTerms = 2 * kDegree + 1;
constexpr std::size_t kChecks = 5;
// Below it each angle is evaluated by itself.
constexpr std::size_t kWorthwhile = 60;
constexpr double kIsOne = 1e-11;

}  // namespace

AnglePolynomials::AnglePolynomials(std::span<const double> angles) {
  if (angles.size() < kWorthwhile) return;
  const auto count = static_cast<Eigen::Index>(angles.size());
  Eigen::MatrixXd basis(count, kTerms);
  const Eigen::Map<const Eigen::ArrayXd> t(angles.data(), count);
  basis.col(0).setOnes();
  basis.col(1) = t.cos();
  basis.col(2) = t.sin();
  for (int k = 2; k <= kDegree; ++k) {
    // cos and sin of the sum of angles.
    const auto c = basis.col(2 * k - 3).array(), s = basis.col(2 * k - 2).array();
    const auto c1 = basis.col(1).array(), s1 = basis.col(2).array();
    basis.col(2 * k - 1) = c * c1 - s * s1;
    basis.col(2 * k) = s * c1 + c * s1;
  }
  // As Chebyshev has them on an arc, evenly on a turn; checks half way between.
  const auto [least, most] = std::ranges::minmax(angles);
  const bool turn = most - least > 1.9 * std::numbers::pi;
  const auto last = static_cast<double>(angles.size() - 1);
  const auto place = [&](double share) {
    const double along = turn ? share : 0.5 * (1.0 - std::cos(std::numbers::pi * share));
    return static_cast<std::size_t>(std::lround(along * last));
  };
  // On a turn the last node is not the first again.
  const double step = 1.0 / (turn ? static_cast<double>(kTerms) : static_cast<double>(kTerms - 1));
  for (Eigen::Index k = 0; k < kTerms; ++k) nodes_.push_back(place(static_cast<double>(k) * step));
  for (std::size_t k = 0; k < kChecks; ++k) {
    checks_.push_back(place((1.6 * static_cast<double>(k) + 0.5) * step));
  }
  Eigen::Matrix<double, kTerms, kTerms> at_nodes;
  for (Eigen::Index k = 0; k < kTerms; ++k) {
    at_nodes.row(k) = basis.row(static_cast<Eigen::Index>(nodes_[static_cast<std::size_t>(k)]));
  }
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, kTerms, kTerms>> factors(at_nodes);
  if (factors.rank() < kTerms) return;
  // Row by row of the transposed system, so that an arc, whose coefficients are uncertain, leaves
  // the values as certain as they are.
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, kTerms, kTerms>> transposed(
      at_nodes.transpose());
  weights_ = transposed.solve(basis.transpose()).transpose();
}

std::optional<Eigen::MatrixXd> AnglePolynomials::at_all(
    Eigen::Index columns, const std::function<Eigen::RowVectorXd(std::size_t)>& values) const {
  if (weights_.size() == 0) return std::nullopt;
  Eigen::MatrixXd at_nodes(kTerms, columns);
  for (Eigen::Index k = 0; k < kTerms; ++k) {
    at_nodes.row(k) = values(nodes_[static_cast<std::size_t>(k)]);
  }
  const Eigen::RowVectorXd size = at_nodes.cwiseAbs().colwise().maxCoeff();
  for (const std::size_t i : checks_) {
    const Eigen::RowVectorXd off =
        weights_.row(static_cast<Eigen::Index>(i)) * at_nodes - values(i);
    for (Eigen::Index k = 0; k < columns; ++k) {
      if (!(std::abs(off[k]) <= kIsOne * std::max(size[k], 1.0))) return std::nullopt;
    }
  }
  return Eigen::MatrixXd(weights_ * at_nodes);
}

}  // namespace frustum::instruments
