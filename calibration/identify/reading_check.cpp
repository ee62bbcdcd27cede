#include "calibration/identify/reading_check.hpp"

#include <algorithm>
#include <cmath>

#include "calibration/identify/distributions.hpp"
#include "core/linear_algebra.hpp"

namespace frustum::calibration {
namespace {

// Of a unit error in a reading the residuals show so little that nothing is said of it.
constexpr double kUnchecked = 1e-6;
// Sums of squares that differ by less, in variances, are a chance: four standard deviations.
constexpr double kChance = 16.0;

// 1 - A (A^T A)^-1 A^T, with columns of length one.
Eigen::MatrixXd residual_projection(const Eigen::MatrixXd& model) {
  Eigen::MatrixXd a = model;
  for (Eigen::Index k = 0; k < a.cols(); ++k) {
    if (const double size = a.col(k).norm(); size > 0.0) a.col(k) /= size;
  }
  const SymmetricFactors normal(a.transpose() * a);
  const Eigen::MatrixXd fitted = a * normal.solve(Eigen::MatrixXd(a.transpose()));
  return Eigen::MatrixXd::Identity(a.rows(), a.rows()) - fitted;
}

struct SuspectGroup {
  std::size_t group = 0;
  double fall = 0.0;  // of the sum of squares without it
  int rank = 0;       // of what of it is checked
  Eigen::VectorXd excess{};
};

std::vector<SuspectGroup> suspect_groups(const Eigen::MatrixXd& projection,
                                         const Eigen::VectorXd& residuals, Eigen::Index size) {
  std::vector<SuspectGroup> all;
  for (Eigen::Index at = 0; at + size <= residuals.size(); at += size) {
    const SymmetricEigen own = symmetric_eigen(projection.block(at, at, size, size));
    const Eigen::VectorXd v = residuals.segment(at, size);
    SuspectGroup each{.group = static_cast<std::size_t>(at / size),
                      .excess = Eigen::VectorXd::Zero(size)};
    for (Eigen::Index k = 0; k < size; ++k) {
      if (!(own.values[k] > kUnchecked)) continue;
      const double along = own.vectors.col(k).dot(v);
      each.excess += along / own.values[k] * own.vectors.col(k);
      each.fall += along * along / own.values[k];
      ++each.rank;
    }
    if (each.rank > 0) all.push_back(std::move(each));
  }
  std::ranges::stable_sort(all, std::ranges::greater{}, &SuspectGroup::fall);
  return all;
}

}  // namespace

ReadingCheck reading_check(const Eigen::MatrixXd& model, const Eigen::VectorXd& readings,
                           const ReadingCheckOptions& options) {
  const Eigen::MatrixXd projection = residual_projection(model);
  ReadingCheck check{.residuals = projection * readings};
  const Eigen::Index count = readings.size();
  check.degrees_of_freedom = static_cast<int>(count - model.cols());
  check.sum_of_squares = check.residuals.squaredNorm();
  check.rms = std::sqrt(check.sum_of_squares / static_cast<double>(count));
  Eigen::Index largest = 0;
  check.residuals.cwiseAbs().maxCoeff(&largest);
  check.largest = static_cast<std::size_t>(largest);
  check.redundancy = projection.diagonal().cwiseMax(0.0);
  check.standard_deviations = options.noise * check.redundancy.cwiseSqrt();
  if (check.degrees_of_freedom <= 0) return check;
  if (options.noise > 0.0) {
    const double variance = options.noise * options.noise;
    check.expected_rms =
        options.noise * std::sqrt(check.degrees_of_freedom / static_cast<double>(count));
    check.probability = chi_square_tail(check.sum_of_squares / variance, check.degrees_of_freedom);
    check.consistent = *check.probability >= kInconsistent;
  } else {
    check.consistent = check.rms <= options.least_rms;
  }

  const auto size = static_cast<Eigen::Index>(options.group_size);
  const auto candidates = suspect_groups(projection, check.residuals, size);
  if (candidates.empty() || check.degrees_of_freedom <= candidates.front().rank) return check;
  const SuspectGroup& first = candidates.front();
  const double rest = std::max(check.sum_of_squares - first.fall, 0.0);
  const double variance =
      std::max(rest / (check.degrees_of_freedom - first.rank), options.noise * options.noise);
  const double least = options.noise > 0.0 ? 0.0 : options.least_excess;
  if (first.fall <= kSuspect * first.rank * variance || first.excess.norm() <= least) {
    return check;
  }
  check.consistent = false;
  check.excess = first.excess;
  check.rms_without = std::sqrt(rest / static_cast<double>(count - size));
  for (const SuspectGroup& each : candidates) {
    if (first.fall - each.fall > kChance * variance) break;
    check.suspects.push_back(each.group);
  }
  return check;
}

}  // namespace frustum::calibration
