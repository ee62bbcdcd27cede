// What was measured, what it depends on, and what is to be found: the input of the identification.
//
// Model    : values = gain * unknowns + noise with the given covariance
// Units    : mm, rad; a gain is the row's unit over the unknown's unit
// Shape    : gain rows x unknowns, covariance rows x rows
// Errors   : check() names the part that is missing, not finite or not a covariance
// Accuracy : exact
// Source   : JCGM 102:2011, section 6 (models with several quantities)
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/diagnostic.hpp"

namespace frustum::calibration {

// One measured characteristic.
struct Row {
  std::string name{};   // "1-a.dL"
  std::string group{};  // what is cut and measured together: "1-a"
  bool angular = false;
};

// What is known of an unknown from elsewhere.
struct Prior {
  double value = 0.0;
  double standard_deviation = 0.0;  // 0: known exactly
};

// A machine error, a tool radius error.
struct Unknown {
  std::string name{};
  bool angular = false;
  std::optional<Prior> prior{};
  std::optional<double> fixed{};  // known exactly; goes before the prior

  // Not estimated: `fixed`, or a prior without standard deviation.
  [[nodiscard]] bool is_fixed() const;
  [[nodiscard]] double fixed_value() const;
};

struct Observations {
  std::vector<Row> rows{};
  std::vector<Unknown> unknowns{};
  Eigen::MatrixXd gain{};
  Eigen::VectorXd values{};
  Eigen::MatrixXd covariance{};

  [[nodiscard]] Observations selected(std::span<const Eigen::Index> rows) const;
};

// Size that an error is expected to have: of a good machine before it is adjusted. Only the
// question "can it be identified?" depends on it, never a number that is reported.
constexpr double kExpectedAngle = 30e-6;   // rad
constexpr double kExpectedLength = 15e-3;  // mm

// The prior's standard deviation, else one of the two above.
[[nodiscard]] double expected_size(const Unknown& unknown);

// Empty when the sizes agree, everything is finite, and the covariance is symmetric with positive
// variances and no negative eigenvalue.
[[nodiscard]] Diagnostics check(const Observations& observations);

}  // namespace frustum::calibration
