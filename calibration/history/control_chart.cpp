#include "calibration/history/control_chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustum::calibration {
namespace {

// As printed: 3 / d2 with d2 = 1.128, and D4 of subgroups of two.
constexpr double kFactorOfValues = 2.66, kFactorOfRanges = 3.267;

// Of a limit, by the largest magnitude M, the spread S of n values, and u = epsilon / 2. A value is
// its decimal within u M, a difference of two within 2 u M and u S more; n of them summed and
// divided are within (n + 1) u S. The mean of ranges enters 3.267 times at most, the mean once,
// and what they make is rounded to u (M + 3.267 S): below 4 (n + 4) u S + 12 u M in all.
double rounding_of(std::span<const double> values) {
  const auto [least, most] = std::ranges::minmax(values);
  const double largest = std::max(std::abs(least), std::abs(most));
  const auto count = static_cast<double>(values.size());
  return std::numeric_limits<double>::epsilon() *
         (2.0 * (count + 4.0) * (most - least) + 6.0 * largest);
}

}  // namespace

std::vector<std::optional<double>> moving_ranges(std::span<const double> values,
                                                 const std::vector<bool>& anew) {
  std::vector<std::optional<double>> ranges(values.size());
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (i < anew.size() && anew[i]) continue;
    ranges[i] = std::abs(values[i] - values[i - 1]);
  }
  return ranges;
}

std::optional<ControlLimits> control_limits(std::span<const double> values,
                                            const std::vector<bool>& anew) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const auto& range : moving_ranges(values, anew)) {
    if (!range) continue;
    sum += *range;
    ++count;
  }
  if (values.size() < kFewestForLimits || count + 1 < kFewestForLimits) return std::nullopt;
  // From the first value on: what is rounded is of the size of the spread, not of the values.
  double from_first = 0.0;
  for (const double value : values) from_first += value - values[0];
  ControlLimits limits{.mean = values[0] + from_first / static_cast<double>(values.size()),
                       .mean_moving_range = sum / static_cast<double>(count),
                       .rounding = rounding_of(values),
                       .values = values.size()};
  limits.lower = limits.mean - kFactorOfValues * limits.mean_moving_range;
  limits.upper = limits.mean + kFactorOfValues * limits.mean_moving_range;
  limits.upper_moving_range = kFactorOfRanges * limits.mean_moving_range;
  return limits;
}

}  // namespace frustum::calibration
