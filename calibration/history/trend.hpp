// How fast values change with time: the least-squares straight line, and how well its slope is
// known.
//
// Model    : value = centre_value + slope (day - centre_day) + scatter, which is normal, equal and
//            without memory; the interval of the slope is Student's with n - 2 degrees of freedom
// Units    : days; those of the values, per day
// Shape    : n >= 3 pairs of which at least two days differ
// Errors   : none; nothing where there are fewer
// Accuracy : 1e-12 relative of well-spread days (tests/calibration/history_test.cpp)
// Source   : ordinary least squares (any textbook); no standard of control charts has a rule for it
#pragma once

#include <optional>
#include <span>

namespace frustum::calibration {

struct Trend {
  double slope = 0.0;       // per day
  double half_width = 0.0;  // of the 95 % interval of the slope, per day
  double centre_day = 0.0, centre_value = 0.0;
  double residual_sd = 0.0;  // about the line

  [[nodiscard]] double at(double day) const { return centre_value + slope * (day - centre_day); }
  // Zero is outside the interval of the slope.
  [[nodiscard]] bool is_significant() const;
};

// As many days as values.
[[nodiscard]] std::optional<Trend> trend_of(std::span<const double> days,
                                            std::span<const double> values);

}  // namespace frustum::calibration
