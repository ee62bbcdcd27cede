#include "calibration/identify/identification.hpp"

#include <Eigen/Core>
#include <cmath>

#include "calibration/identify/distributions.hpp"
#include "calibration/identify/findings.hpp"
#include "core/linear_algebra.hpp"

namespace frustum::calibration {
namespace {

struct Solution {
  Eigen::VectorXd scaled;      // of the free unknowns, in expected sizes
  Eigen::MatrixXd covariance;  // of `scaled`
};

Solution solve(const WeightedSystem& system, int rank) {
  const SingularValues svd = singular_values(system.matrix, SingularVectors::thin);
  const Eigen::VectorXd inverse = svd.values.head(rank).cwiseInverse();
  const Eigen::MatrixXd v = svd.right.leftCols(rank) * inverse.asDiagonal();
  return {v * (svd.left.leftCols(rank).transpose() * system.right), v * v.transpose()};
}

void fill_estimates(const Observations& observations, const WeightedSystem& system,
                    const Solution& solution, double coverage, Identification& result) {
  const auto count = static_cast<Eigen::Index>(observations.unknowns.size());
  result.working_point = Eigen::VectorXd::Zero(count);
  result.covariance = Eigen::MatrixXd::Zero(count, count);
  for (const Unknown& unknown : observations.unknowns) {
    Estimate& estimate = result.estimates.emplace_back();
    estimate.name = unknown.name;
    estimate.angular = unknown.angular;
    estimate.fixed = unknown.is_fixed();
    if (!estimate.fixed) continue;
    const double value = unknown.fixed_value();
    result.working_point[static_cast<Eigen::Index>(result.estimates.size()) - 1] = value;
    estimate.value = estimate.lower = estimate.upper = value;
    estimate.standard_uncertainty = 0.0;
  }
  const Eigen::VectorXd values = system.size.cwiseProduct(solution.scaled);
  result.working_point(system.free) = values;

  Eigen::VectorXd identified = Eigen::VectorXd::Zero(values.size());
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    const auto unknown = static_cast<std::size_t>(system.free[static_cast<std::size_t>(j)]);
    if (!result.observability.identified[unknown]) continue;
    identified[j] = 1.0;
    const double u = system.size[j] * std::sqrt(solution.covariance(j, j));
    Estimate& estimate = result.estimates[unknown];
    estimate.value = values[j];
    estimate.standard_uncertainty = u;
    estimate.lower = values[j] - coverage * u;
    estimate.upper = values[j] + coverage * u;
  }
  const Eigen::VectorXd scale = system.size.cwiseProduct(identified);
  result.covariance(system.free, system.free) =
      scale.asDiagonal() * solution.covariance * scale.asDiagonal();
}

void fill_combinations(const WeightedSystem& system, const Solution& solution, double coverage,
                       Identification& result) {
  for (const Combination& combination : result.observability.estimable) {
    Eigen::VectorXd all = Eigen::VectorXd::Zero(result.working_point.size());
    for (const Term& term : combination.terms) all[term.unknown] = term.coefficient;
    const Eigen::VectorXd scaled = system.size.cwiseProduct(Eigen::VectorXd(all(system.free)));
    const double value = scaled.dot(solution.scaled);
    const double u = std::sqrt(scaled.dot(solution.covariance * scaled));
    result.combinations.push_back(
        {combination, value, u, value - coverage * u, value + coverage * u});
  }
}

void judge(Residual& residual, double residual_variance, double variance, double weighted,
           double weighted_variance) {
  // Less than a millionth of the variance left over is rounding: nothing checks this row.
  if (residual_variance < 1e-6 * variance || !(weighted_variance > 0.0)) return;
  residual.normalised = residual.residual / std::sqrt(residual_variance);
  residual.w = weighted / std::sqrt(weighted_variance);
  residual.outlier = std::abs(*residual.normalised) > kOutlier;
}

void fill_rows(const Observations& observations, const WeightedSystem& system,
               const Solution& solution, Identification& result) {
  const Eigen::VectorXd values = system.size.cwiseProduct(solution.scaled);
  const Eigen::VectorXd residuals = system.values - system.gain * values;
  const Eigen::MatrixXd covariance =
      system.size.asDiagonal() * solution.covariance * system.size.asDiagonal();
  const Eigen::MatrixXd left =
      system.covariance - system.gain * covariance * system.gain.transpose();
  const Eigen::MatrixXd weights = system.whitening.transpose() * system.whitening;  // S^+
  const Eigen::VectorXd weighted = weights * residuals;
  const Eigen::MatrixXd weighted_covariance = weights * left * weights;
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    const Row& row = observations.rows[static_cast<std::size_t>(i)];
    Residual& residual = result.residuals.emplace_back();
    residual.name = row.name;
    residual.angular = row.angular;
    residual.measured = observations.values[i];
    residual.residual = residuals[i];
    residual.predicted = residual.measured - residual.residual;
    judge(residual, left(i, i), system.covariance(i, i), weighted[i], weighted_covariance(i, i));
  }
}

void fill_priors(const Observations& observations, const WeightedSystem& system,
                 const Solution& solution, Identification& result) {
  for (const Eigen::Index j : system.priors) {
    const Unknown& unknown =
        observations.unknowns[static_cast<std::size_t>(system.free[static_cast<std::size_t>(j)])];
    Residual& residual = result.residuals.emplace_back();
    residual.name = "prior " + unknown.name;
    residual.angular = unknown.angular;
    residual.prior = true;
    residual.measured = unknown.prior->value;
    residual.predicted = system.size[j] * solution.scaled[j];
    residual.residual = residual.measured - residual.predicted;
    const double variance = unknown.prior->standard_deviation * unknown.prior->standard_deviation;
    const double left = variance - system.size[j] * system.size[j] * solution.covariance(j, j);
    // A prior is independent of all else: its w is its normalised residual.
    judge(residual, left, variance, residual.residual, left);
  }
}

// `chi_square` is there.
void fill_agreement(const WeightedSystem& system, Identification& result) {
  Agreement& agreement = result.agreement;
  agreement.degrees_of_freedom = static_cast<int>(system.matrix.rows()) - result.observability.rank;
  if (agreement.degrees_of_freedom <= 0) return;
  agreement.probability = chi_square_tail(agreement.chi_square, agreement.degrees_of_freedom);
  agreement.birge = std::sqrt(agreement.chi_square / agreement.degrees_of_freedom);
  agreement.rejected = *agreement.probability < kRejection;
}

std::optional<std::size_t> suspect_of(const std::vector<Residual>& residuals) {
  std::optional<std::size_t> suspect;
  double largest = kSnooping;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    const double w = std::abs(residuals[i].w.value_or(0.0));
    if (w <= largest) continue;
    largest = w;
    suspect = i;
  }
  return suspect;
}

}  // namespace

Result<Identification> identify(const Observations& observations, const IdentifyOptions& options) {
  if (!(options.confidence > 0.0 && options.confidence < 1.0)) {
    return error("out-of-range"_id, "the confidence of the intervals must be between 0 and 1",
                 "0.95 is usual");
  }
  if (options.degrees_of_freedom &&
      (!(*options.degrees_of_freedom >= 1.0) || !std::isfinite(*options.degrees_of_freedom))) {
    return error("covariance"_id,
                 "the degrees of freedom of the covariance have to be at least 1 and finite");
  }
  const auto system = weighted_system(observations, options.floor);
  if (!system) return system.error();
  Identification result;
  result.observability = observability(observations, *system);
  const Solution solution = solve(*system, result.observability.rank);
  result.agreement.chi_square = (system->right - system->matrix * solution.scaled).squaredNorm();
  if (!solution.scaled.allFinite() || !std::isfinite(result.agreement.chi_square)) {
    return error("range-of-numbers"_id, "the measurements leave the range of numbers",
                 "check their units");
  }
  const double coverage = coverage_factor(options.confidence, options.degrees_of_freedom);
  fill_estimates(observations, *system, solution, coverage, result);
  fill_combinations(*system, solution, coverage, result);
  fill_rows(observations, *system, solution, result);
  fill_priors(observations, *system, solution, result);
  fill_agreement(*system, result);
  result.suspect = suspect_of(result.residuals);
  result.diagnostics = findings(observations, *system, result);
  return result;
}

}  // namespace frustum::calibration
