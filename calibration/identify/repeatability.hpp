// Several parts of one kind: their mean, and its covariance from the scatter or the measuring
// machine, whichever is larger.
//
// Model    : s_i^2 scatter of row i over n parts; q^2 = mean of s_i^2 / sigma_i^2 over the rows of
//            one kind (lengths, angles), sigma_i from the measuring machine's covariance S of one
//            part. Covariance of the mean = D S D, D_i = max(1, q / sqrt(n)).
//            S is not divided by n: scale and squareness of one measuring machine are common to all
//            parts. Scatter is pooled by kind, because two or three parts do not identify that of
//            one row. The correlations are those of S
// Units    : mm, rad
// Shape    : n >= 1 parts of equal size; with one the covariance is S
// Errors   : no part, sizes that differ, values that are not finite, variances that are not
//            positive
// Accuracy : exact
// Source   : JCGM 100:2008, sections 4.2 and 4.3
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "calibration/identify/observations.hpp"
#include "core/result.hpp"

namespace frustum::calibration {

struct PooledParts {
  Eigen::VectorXd mean{};
  Eigen::MatrixXd covariance{};  // of the mean
  Eigen::VectorXd scatter{};     // s_i, empty with one part
  // q of lengths and angles: above sqrt(n) the parts scatter more than the measuring machine.
  double scatter_lengths = 0.0;
  double scatter_angles = 0.0;
  // (n - 1) times the rows of the kind whose scatter counts, the smaller of the two; nothing where
  // the measuring machine's covariance counts. Characteristics that share surfaces make this too
  // large.
  std::optional<double> degrees_of_freedom{};
};

[[nodiscard]] Result<PooledParts> pool(std::span<const Row> rows,
                                       std::span<const Eigen::VectorXd> parts,
                                       const Eigen::MatrixXd& covariance_of_one);

}  // namespace frustum::calibration
