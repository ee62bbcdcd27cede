#include "calibration/history/trend.hpp"

#include <cmath>
#include <cstddef>

#include "calibration/identify/distributions.hpp"

namespace frustum::calibration {

bool Trend::is_significant() const { return std::abs(slope) > half_width; }

std::optional<Trend> trend_of(std::span<const double> days, std::span<const double> values) {
  const std::size_t n = values.size();
  if (n < 3 || days.size() != n) return std::nullopt;
  Trend trend;
  for (std::size_t i = 0; i < n; ++i) {
    trend.centre_day += (days[i] - days[0]) / static_cast<double>(n);
    trend.centre_value += values[i] / static_cast<double>(n);
  }
  trend.centre_day += days[0];
  double spread = 0.0, together = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double along = days[i] - trend.centre_day;
    spread += along * along;
    together += along * (values[i] - trend.centre_value);
  }
  if (!(spread > 0.0)) return std::nullopt;
  trend.slope = together / spread;
  double squares = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double left = values[i] - trend.at(days[i]);
    squares += left * left;
  }
  const auto freedom = static_cast<double>(n - 2);
  trend.residual_sd = std::sqrt(squares / freedom);
  trend.half_width = coverage_factor(0.95, freedom) * trend.residual_sd / std::sqrt(spread);
  return trend;
}

}  // namespace frustum::calibration
