// Whether the readings of a calibration agree with one another, and which of them does not.
//
// Model    : readings y = A x + noise; residuals v = Q y with Q = 1 - A (A^T A)^-1 A^T. Readings
//            i of one group that are off by g leave Q g: the most likely g is Q_ii^+ v_i, and
//            without the group the sum of squares falls by v_i^T Q_ii^+ v_i. The group that takes
//            most is suspect where that is more than kSuspect times as much, per reading, as what
//            noise or the rest leaves; others that take as much, but for a chance, are named with
//            it
// Units    : mm, as the readings
// Shape    : readings of a group follow each other
// Errors   : none
// Accuracy : rounding, times the condition of A with columns of length one
// Source   : Baarda 1968, A testing procedure for use in geodetic networks; JCGM 102:2011
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

namespace frustum::calibration {

// Five standard deviations: one of a few hundred right readings exceeds it once in thousands of
// calibrations.
constexpr double kSuspect = 25.0;
// A right calibration is warned of once in a thousand.
constexpr double kInconsistent = 1e-3;

struct ReadingCheckOptions {
  double noise = 0.0;          // standard deviation of a reading; 0: not stated
  std::size_t group_size = 1;  // of readings that are wrong together
  // Below them nothing is said where no noise is stated: what a probe repeats to, and what errors
  // that the unknowns do not describe commonly leave.
  double least_excess = 1e-3;
  double least_rms = 1e-2;
};

struct ReadingCheck {
  Eigen::VectorXd residuals{};
  // Of a reading that is off by one its residual shows so much; zero: nothing checks it, and what
  // it is off by goes into the unknowns without a trace.
  Eigen::VectorXd redundancy{};
  Eigen::VectorXd standard_deviations{};  // of the residuals, by the noise; zero: not stated
  int degrees_of_freedom = 0;
  double rms = 0.0;
  std::size_t largest = 0;  // reading with the largest residual
  std::optional<double> expected_rms{};
  std::optional<double> probability{};  // of residuals as large by noise alone
  bool consistent = true;
  // Groups, the likeliest first: one of them alone is wrong. Empty: none stands out.
  std::vector<std::size_t> suspects{};
  Eigen::VectorXd excess{};     // of the first of them
  double rms_without = 0.0;     // and what its absence leaves
  double sum_of_squares = 0.0;  // of all residuals
};

[[nodiscard]] ReadingCheck reading_check(const Eigen::MatrixXd& model,
                                         const Eigen::VectorXd& readings,
                                         const ReadingCheckOptions& options);

}  // namespace frustum::calibration
