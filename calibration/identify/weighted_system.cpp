#include "calibration/identify/weighted_system.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/linear_algebra.hpp"

namespace frustum::calibration {
namespace {

// Correlations are kept; the standard deviations grow.
Eigen::MatrixXd with_floor(const Observations& o, const Floor& floor) {
  Eigen::VectorXd growth(o.gain.rows());
  for (Eigen::Index i = 0; i < growth.size(); ++i) {
    const double added = o.rows[static_cast<std::size_t>(i)].angular ? floor.angle : floor.length;
    const double variance = o.covariance(i, i);
    growth[i] = std::sqrt((variance + added * added) / variance);
  }
  const Eigen::MatrixXd symmetric = 0.5 * (o.covariance + o.covariance.transpose());
  return growth.asDiagonal() * symmetric * growth.asDiagonal();
}

Diagnostics whiten(WeightedSystem& system) {
  const Eigen::VectorXd sd = system.covariance.diagonal().cwiseSqrt();
  const Eigen::MatrixXd correlation =
      sd.cwiseInverse().asDiagonal() * system.covariance * sd.cwiseInverse().asDiagonal();
  const SymmetricEigen eigen = symmetric_eigen(correlation);
  if (!eigen.converged) return {error("covariance"_id, "the covariance has no eigenvalues")};
  const Eigen::VectorXd& values = eigen.values;  // ascending
  if (values[0] < -kRounding) {
    return {
        error("covariance"_id,
              fmt::format("the covariance has a negative eigenvalue ({:.3g} of its correlations)",
                          values[0]),
              "a covariance is a sum of squares: check its signs")};
  }
  const Eigen::Index dropped = (values.array() < kRounding).count();
  const Eigen::Index kept = values.size() - dropped;
  system.whitened_rows = kept;
  system.without_noise = eigen.vectors.leftCols(dropped);
  system.whitening = values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal() *
                     eigen.vectors.rightCols(kept).transpose() * sd.cwiseInverse().asDiagonal();
  return {};
}

void take_off_fixed(const Observations& o, WeightedSystem& system) {
  system.values = o.values;
  std::vector<double> sizes;
  for (Eigen::Index j = 0; j < o.gain.cols(); ++j) {
    const Unknown& unknown = o.unknowns[static_cast<std::size_t>(j)];
    if (unknown.is_fixed()) {
      system.values -= unknown.fixed_value() * o.gain.col(j);
      continue;
    }
    if (unknown.prior) system.priors.push_back(static_cast<Eigen::Index>(system.free.size()));
    system.free.push_back(j);
    sizes.push_back(expected_size(unknown));
  }
  system.gain = o.gain(Eigen::all, system.free);
  system.size =
      Eigen::Map<const Eigen::VectorXd>(sizes.data(), static_cast<Eigen::Index>(sizes.size()));
}

}  // namespace

Result<WeightedSystem> weighted_system(const Observations& observations, const Floor& floor) {
  Diagnostics wrong = check(observations);
  if (!wrong.empty()) return wrong;
  if (!(floor.length >= 0.0 && floor.angle >= 0.0) || !std::isfinite(floor.length + floor.angle)) {
    return error("uncertainty-not-positive"_id,
                 "the floor of the uncertainties is negative or not finite");
  }
  WeightedSystem system;
  take_off_fixed(observations, system);
  if (system.free.empty()) {
    return error("nothing-to-identify"_id, "every unknown is fixed: nothing is left to identify",
                 "release one of them");
  }
  system.covariance = with_floor(observations, floor);
  if (!system.covariance.allFinite())
    return error("covariance"_id, "the covariance with its floor is too large");
  wrong = whiten(system);
  if (!wrong.empty()) return wrong;

  const Eigen::Index rows = system.whitened_rows;
  const auto priors = static_cast<Eigen::Index>(system.priors.size());
  const auto free = static_cast<Eigen::Index>(system.free.size());
  system.matrix = Eigen::MatrixXd::Zero(rows + priors, free);
  system.right = Eigen::VectorXd::Zero(rows + priors);
  system.matrix.topRows(rows) = system.whitening * system.gain * system.size.asDiagonal();
  system.right.head(rows) = system.whitening * system.values;
  for (Eigen::Index p = 0; p < priors; ++p) {
    const Eigen::Index j = system.priors[static_cast<std::size_t>(p)];
    const Prior& prior =
        *observations.unknowns[static_cast<std::size_t>(system.free[static_cast<std::size_t>(j)])]
             .prior;
    system.matrix(rows + p, j) = system.size[j] / prior.standard_deviation;
    system.right[rows + p] = prior.value / prior.standard_deviation;
  }
  if (!system.matrix.allFinite() || !system.right.allFinite()) {
    return error("range-of-numbers"_id,
                 "measurements over their standard deviations leave the range of numbers",
                 "check the units of values and covariance");
  }
  return system;
}

}  // namespace frustum::calibration
