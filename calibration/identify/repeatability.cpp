#include "calibration/identify/repeatability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace frustum::calibration {
namespace {

Diagnostics wrong_parts(std::span<const Row> rows, std::span<const Eigen::VectorXd> parts,
                        const Eigen::MatrixXd& covariance) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  if (parts.empty())
    return {error("nothing-to-identify"_id, "no measured part", "give at least one")};
  if (covariance.rows() != n || covariance.cols() != n) {
    return {error("covariance"_id, fmt::format("the covariance is {} x {} for {} characteristics",
                                               covariance.rows(), covariance.cols(), n))};
  }
  if (!covariance.allFinite() || !(covariance.diagonal().array() > 0.0).all()) {
    return {error("uncertainty-not-positive"_id,
                  "a variance of the measuring machine is not positive and finite")};
  }
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (parts[p].size() != n) {
      return {error(
          "wrong-size"_id,
          fmt::format("part {} has {} values for {} characteristics", p + 1, parts[p].size(), n),
          "pool only parts that were measured by the same plan")};
    }
    if (!parts[p].allFinite()) {
      return {error("not-a-number"_id,
                    fmt::format("part {} has a value that is not a finite number", p + 1))};
    }
  }
  return {};
}

// q of one kind of rows, and their number.
struct Ratio {
  double value = 0.0;
  int rows = 0;
};

Ratio ratio_of(std::span<const Row> rows, bool angular, const Eigen::VectorXd& scatter,
               const Eigen::MatrixXd& covariance) {
  double sum = 0.0;
  Ratio ratio;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].angular != angular) continue;
    const auto k = static_cast<Eigen::Index>(i);
    sum += scatter[k] * scatter[k] / covariance(k, k);
    ++ratio.rows;
  }
  if (ratio.rows > 0) ratio.value = std::sqrt(sum / ratio.rows);
  return ratio;
}

}  // namespace

Result<PooledParts> pool(std::span<const Row> rows, std::span<const Eigen::VectorXd> parts,
                         const Eigen::MatrixXd& covariance_of_one) {
  Diagnostics wrong = wrong_parts(rows, parts, covariance_of_one);
  if (!wrong.empty()) return wrong;
  const auto count = static_cast<double>(parts.size());
  PooledParts result;
  result.mean = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  for (const Eigen::VectorXd& part : parts) result.mean += part / count;
  result.covariance = covariance_of_one;
  if (parts.size() == 1) return result;

  Eigen::VectorXd squares = Eigen::VectorXd::Zero(result.mean.size());
  for (const Eigen::VectorXd& part : parts) squares += (part - result.mean).cwiseAbs2();
  result.scatter = (squares / (count - 1.0)).cwiseSqrt();
  Eigen::VectorXd growth = Eigen::VectorXd::Ones(result.mean.size());
  for (const bool angular : {false, true}) {
    const Ratio ratio = ratio_of(rows, angular, result.scatter, covariance_of_one);
    (angular ? result.scatter_angles : result.scatter_lengths) = ratio.value;
    const double larger = ratio.value / std::sqrt(count);
    if (larger <= 1.0) continue;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].angular == angular) growth[static_cast<Eigen::Index>(i)] = larger;
    }
    const double freedom = (count - 1.0) * ratio.rows;
    result.degrees_of_freedom = std::min(result.degrees_of_freedom.value_or(freedom), freedom);
  }
  result.covariance = growth.asDiagonal() * covariance_of_one * growth.asDiagonal();
  return result;
}

}  // namespace frustum::calibration
