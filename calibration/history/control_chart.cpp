#include "calibration/history/control_chart.hpp"

#include <cmath>
#include <numeric>

namespace frustum::calibration {
namespace {

// As printed: 3 / d2 with d2 = 1.128, and D4 of subgroups of two.
constexpr double kFactorOfValues = 2.66, kFactorOfRanges = 3.267;

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
  ControlLimits limits{.mean = std::accumulate(values.begin(), values.end(), 0.0) /
                               static_cast<double>(values.size()),
                       .mean_moving_range = sum / static_cast<double>(count),
                       .values = values.size()};
  limits.lower = limits.mean - kFactorOfValues * limits.mean_moving_range;
  limits.upper = limits.mean + kFactorOfValues * limits.mean_moving_range;
  limits.upper_moving_range = kFactorOfRanges * limits.mean_moving_range;
  return limits;
}

}  // namespace frustum::calibration
