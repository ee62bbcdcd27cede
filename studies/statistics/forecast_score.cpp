#include "studies/statistics/forecast_score.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace frustum::studies {

double crps(const Forecast& forecast, double truth) {
  const double z = (truth - forecast.mean) / forecast.sd;
  // 2 Phi(z) - 1
  const double within = std::erf(z / std::numbers::sqrt2);
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
  return forecast.sd * (z * within + 2.0 * density - std::numbers::inv_sqrtpi);
}

double interval_score_95(const Forecast& forecast, double truth) {
  constexpr double kPenalty = 40.0;  // 2 / 0.05
  const double low = forecast.mean - kTwoSided95 * forecast.sd;
  const double high = forecast.mean + kTwoSided95 * forecast.sd;
  return high - low + kPenalty * std::max(0.0, low - truth) +
         kPenalty * std::max(0.0, truth - high);
}

double log_score(const Forecast& forecast, double truth) {
  const double z = (truth - forecast.mean) / forecast.sd;
  return std::log(forecast.sd) + 0.5 * z * z + 0.5 * std::log(2.0 * std::numbers::pi);
}

double expected_crps(double sd) { return sd * std::numbers::inv_sqrtpi; }

}  // namespace frustum::studies
