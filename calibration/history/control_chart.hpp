// The control chart of single values: their own limits, found from how they change from one to the
// next.
//
// Model    : individuals and moving ranges (X-mR): mean +- 2.66 mR, mR the mean of |x_i - x_(i-1)|;
//            a moving range is below 3.267 mR. Both factors are 3 sigma for normal values that do
//            not depend on each other (3 / d2 and D4 of two values)
// Units    : those of the values
// Shape    : values in the order of their dates, at least kFewestForLimits, and one range fewer:
//            with four even one far off all others widens the limits beyond itself
//            ((n-1)^2 > 2.66 n). A value that begins anew (after an adjustment) has no range
// Errors   : none; nothing where there are fewer values
// Accuracy : that of the two factors as printed, 4 digits. Values are doubles nearest to decimals,
//            and sums are rounded: `rounding` bounds by how much a limit differs from that of the
//            decimals, so that equal values are within limits that are equal to them
// Source   : ISO 7870-2:2013, Shewhart control charts (individuals and moving range); Shewhart 1931
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace frustum::calibration {

inline constexpr std::size_t kFewestForLimits = 5;
// Limits of fewer values are provisional: they still move much with each new one.
inline constexpr std::size_t kEnoughForLimits = 20;

struct ControlLimits {
  double mean = 0.0;
  double mean_moving_range = 0.0;
  double lower = 0.0, upper = 0.0;  // of a value
  double upper_moving_range = 0.0;
  double rounding = 0.0;   // of each of them, with that of a value beside it
  std::size_t values = 0;  // that they are found from

  [[nodiscard]] bool is_beyond(double value) const {
    return value < lower - rounding || value > upper + rounding;
  }
  [[nodiscard]] bool is_range_beyond(double range) const {
    return range > upper_moving_range + rounding;
  }
};

// |x_i - x_(i-1)| of each value; the first and those that begin anew have none. `anew`: as many as
// values, or none at all.
[[nodiscard]] std::vector<std::optional<double>> moving_ranges(std::span<const double> values,
                                                               const std::vector<bool>& anew = {});
[[nodiscard]] std::optional<ControlLimits> control_limits(std::span<const double> values,
                                                          const std::vector<bool>& anew = {});

}  // namespace frustum::calibration
