#include "studies/statistics/order_statistics.hpp"

#include <cmath>

#include "core/random.hpp"
#include "studies/statistics/summary.hpp"
#include "tests/law_count.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

TEST(OrderStatisticsReference, RanksAreThoseOfTheIndependentComputation) {
  const auto rank = [](const nlohmann::json& number) {
    return number.is_null() ? std::optional<std::uint64_t>{} : number.get<std::uint64_t>();
  };
  for (const nlohmann::json& row : expected()["order_ranks"]) {
    const OrderRanks ranks = order_ranks(row["n"], row["p"]);
    EXPECT_EQ(ranks.lower, rank(row["lower"])) << row;
    EXPECT_EQ(ranks.upper, rank(row["upper"])) << row;
  }
  for (const nlohmann::json& row : expected()["wilks"]) {
    EXPECT_EQ(wilks_draws(row["coverage"], row["confidence"]), row["draws"].get<std::uint64_t>());
  }
}

// The tails, summed term by term.
TEST(OrderStatistics, RanksHaveTheBinomialTailsThatTheyPromise) {
  for (const std::uint64_t n : {1U, 5U, 40U, 250U}) {
    for (const double p : {0.05, 0.5, 0.9}) {
      std::vector<double> at_most{std::pow(1.0 - p, static_cast<double>(n))};
      double term = at_most.front();
      for (std::uint64_t k = 1; k <= n; ++k) {
        term *= p / (1.0 - p) * static_cast<double>(n - k + 1) / static_cast<double>(k);
        at_most.push_back(at_most.back() + term);
      }
      const OrderRanks ranks = order_ranks(n, p);
      if (ranks.lower) {
        EXPECT_LE(at_most[*ranks.lower - 1], 0.025 + 1e-12);
      }
      EXPECT_GT(at_most[ranks.lower.value_or(0)], 0.025 - 1e-12);
      if (ranks.upper) {
        EXPECT_LE(1.0 - at_most[*ranks.upper - 1], 0.025 + 1e-12);
      }
      const std::uint64_t before = ranks.upper.value_or(n + 1) - 1;
      EXPECT_GT(before == 0 ? 1.0 : 1.0 - at_most[before - 1], 0.025 - 1e-12);
    }
  }
}

TEST(OrderStatistics, QuantilesOfType7AreStraightBetweenTheValues) {
  const std::vector<double> sorted{1.0, 2.0, 4.0, 8.0};
  EXPECT_DOUBLE_EQ(sorted_quantile(sorted, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(sorted_quantile(sorted, 1.0), 8.0);
  EXPECT_DOUBLE_EQ(sorted_quantile(sorted, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(sorted_quantile(sorted, 0.9), 6.8);
  std::vector<double> mixed{8.0, 1.0, 4.0, 2.0};
  EXPECT_DOUBLE_EQ(unsorted_quantile(mixed, 0.9), 6.8);
}

TEST(OrderStatistics, BandOfDkwIsThatOfMassart) {
  EXPECT_NEAR(dkw_half_width(1000), std::sqrt(std::log(40.0) / 2000.0), 1e-15);
}

// 95 % intervals of many studies hold what they are about, and no study knows the answer.
TEST(OrderStatisticsLaws, IntervalsCoverMedianAndUpperQuantile) {
  const auto studies = proof::law_count<std::uint32_t>(1000, 200);
  constexpr std::size_t kDraws = 1000;
  std::uint32_t of_median = 0, of_upper = 0;
  std::vector<double> values(kDraws);
  for (std::uint32_t s = 0; s < studies; ++s) {
    for (std::size_t i = 0; i < kDraws; ++i) values[i] = uniform({s, 0}, i);
    std::sort(values.begin(), values.end());
    const Interval median = quantile_interval(values, 0.5);
    const Interval upper = quantile_interval(values, 0.95);
    if (*median.lo <= 0.5 && 0.5 <= *median.hi) ++of_median;
    if (*upper.lo <= 0.95 && 0.95 <= *upper.hi) ++of_upper;
  }
  // 93.5 to 96.5 % of 1,000; of fewer studies the scatter of the rate is wider.
  const double slack = 0.015 * std::sqrt(1000.0 / studies);
  EXPECT_NEAR(of_median / static_cast<double>(studies), 0.95, slack);
  EXPECT_NEAR(of_upper / static_cast<double>(studies), 0.95, slack);
}

}  // namespace
}  // namespace frustum::studies
