#include "instruments/angle_polynomials.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustum::instruments {
namespace {

constexpr int kDegree = 3;
constexpr Eigen::Index kTerms = 2 * kDegree + 1;
constexpr std::size_t kChecks = 5;
// Below it each angle is evaluated by itself.
constexpr std::size_t kWorthwhile = 60;
constexpr double kIsOne = 1e-11;

}  // namespace

AnglePolynomials::AnglePolynomials(std::span<const double> angles) {
  if (angles.size() < kWorthwhile) return;
  const auto count = static_cast<Eigen::Index>(angles.size());
  basis_.resize(count, kTerms);
  const Eigen::Map<const Eigen::ArrayXd> t(angles.data(), count);
  basis_.col(0).setOnes();
  basis_.col(1) = t.cos();
  basis_.col(2) = t.sin();
  for (int k = 2; k <= kDegree; ++k) {
    // cos and sin of the sum of angles.
    const auto c = basis_.col(2 * k - 3).array(), s = basis_.col(2 * k - 2).array();
    const auto c1 = basis_.col(1).array(), s1 = basis_.col(2).array();
    basis_.col(2 * k - 1) = c * c1 - s * s1;
    basis_.col(2 * k) = s * c1 + c * s1;
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
}

std::optional<Eigen::MatrixXd> AnglePolynomials::coefficients(
    Eigen::Index columns, const std::function<Eigen::RowVectorXd(std::size_t)>& values) const {
  if (basis_.size() == 0) return std::nullopt;
  Eigen::Matrix<double, kTerms, kTerms> at_nodes;
  Eigen::MatrixXd known(kTerms, columns);
  for (Eigen::Index k = 0; k < kTerms; ++k) {
    const std::size_t node = nodes_[static_cast<std::size_t>(k)];
    at_nodes.row(k) = basis_.row(static_cast<Eigen::Index>(node));
    known.row(k) = values(node);
  }
  // On an arc coefficients are uncertain, but not what they make between the nodes.
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, kTerms, kTerms>> factors(at_nodes);
  if (factors.rank() < kTerms) return std::nullopt;
  const Eigen::MatrixXd found = factors.solve(known);
  const Eigen::RowVectorXd size = known.cwiseAbs().colwise().maxCoeff();
  for (const std::size_t i : checks_) {
    const Eigen::RowVectorXd off = basis_.row(static_cast<Eigen::Index>(i)) * found - values(i);
    for (Eigen::Index k = 0; k < columns; ++k) {
      if (!(std::abs(off[k]) <= kIsOne * std::max(size[k], 1.0))) return std::nullopt;
    }
  }
  return found;
}

std::optional<Eigen::MatrixXd> AnglePolynomials::at_all(
    Eigen::Index columns, const std::function<Eigen::RowVectorXd(std::size_t)>& values) const {
  const auto found = coefficients(columns, values);
  if (!found) return std::nullopt;
  return Eigen::MatrixXd(basis_ * *found);
}

}  // namespace frustum::instruments
