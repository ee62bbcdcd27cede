#include "studies/statistics/forecast_score.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace frustum::studies {
namespace {

TEST(ForecastScore, IsThatOfTheCheckValues) {
  const struct {
    double y, mean, sd, crps, interval, log;
  } known[] = {{1.0, 0.0, 1.0, 0.602441, 3.919928, 1.418939},
               {-2.0, -1.5, 0.5, 0.301221, 1.959964, 0.725791},
               {0.5, 0.5, 2.0, 0.46739, 7.839856, 1.612086},
               {8.0, 2.0, 2.0, 4.873149, 91.042737, 6.112086}};
  for (const auto& k : known) {
    EXPECT_NEAR(crps({k.mean, k.sd}, k.y), k.crps, 1e-6);
    EXPECT_NEAR(interval_score_95({k.mean, k.sd}, k.y), k.interval, 1e-6);
    EXPECT_NEAR(log_score({k.mean, k.sd}, k.y), k.log, 1e-6);
  }
}

// Of a truth that is N(0, 1), as the midpoints of many strips of equal probability.
TEST(ForecastScore, LawNobodyGainsByStatingOtherThanTheyBelieve) {
  const auto mean_of = [](auto&& score, const Forecast& stated) {
    double sum = 0.0;
    constexpr int kStrips = 4000;
    for (int i = 0; i < kStrips; ++i) {
      const double y = -6.0 + 12.0 * (i + 0.5) / kStrips;
      sum += score(stated, y) * std::exp(-0.5 * y * y) / std::sqrt(2.0 * M_PI) * 12.0 / kStrips;
    }
    return sum;
  };
  for (const auto score : {crps, interval_score_95, log_score}) {
    const double honest = mean_of(score, {0.0, 1.0});
    for (const Forecast other : {Forecast{0.1, 1.0}, {-0.3, 1.0}, {0.0, 0.9}, {0.0, 1.2}}) {
      EXPECT_GT(mean_of(score, other), honest);
    }
  }
  EXPECT_NEAR(mean_of(crps, {0.0, 1.0}), expected_crps(1.0), 1e-6);
}

}  // namespace
}  // namespace frustum::studies
