// Observations brought to unit weight: whitened rows, known errors as rows of their own, unknowns
// in units of their expected size.
//
// Model    : S = D R D, D standard deviations (with the floor), R correlations = V diag(e) V^T.
//            Eigenvalues e below `kRounding` are truncated: W = diag(e)^-1/2 V^T D^-1
//            matrix = [W A diag(size); diag(size / prior sd)], right likewise
//            A combination of rows without noise (characteristics of the same surfaces) is left out
//            of the fit and kept in `without_noise`
// Units    : dimensionless inside; `size` in mm and rad
// Shape    : (whitened rows + priors) x free unknowns
// Errors   : those of check(); a covariance with a negative eigenvalue; nothing left to estimate
// Accuracy : rounding
// Source   : Rao, Linear Statistical Inference, section 4i (singular covariance)
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/identify/observations.hpp"
#include "core/result.hpp"

namespace frustum::calibration {

// Added in quadrature to the standard deviation of every row for what neither the measuring machine
// nor the model knows (straightness of axes, tool deflection). Correlations are kept, so that rows
// from the same surfaces do not count twice.
struct Floor {
  double length = 0.0;  // mm
  double angle = 0.0;   // rad
};

// A combination of rows whose correlation eigenvalue is below this would be known a thousand times
// better than the rows themselves. No stated covariance is that good: it is rounding.
constexpr double kRounding = 1e-6;

struct WeightedSystem {
  std::vector<Eigen::Index> free{};    // unknowns that are estimated
  std::vector<Eigen::Index> priors{};  // of those, indices into `free` with a prior
  Eigen::VectorXd size{};              // expected size of each free unknown
  Eigen::MatrixXd matrix{};
  Eigen::VectorXd right{};
  Eigen::Index whitened_rows = 0;
  Eigen::MatrixXd whitening{};      // W: whitened rows x rows
  Eigen::MatrixXd covariance{};     // of the rows, with the floor
  Eigen::MatrixXd gain{};           // rows x free, internal units
  Eigen::VectorXd values{};         // less the fixed unknowns
  Eigen::MatrixXd without_noise{};  // rows x combinations, of rows over their standard deviations
};

[[nodiscard]] Result<WeightedSystem> weighted_system(const Observations& observations,
                                                     const Floor& floor = {});

}  // namespace frustum::calibration
