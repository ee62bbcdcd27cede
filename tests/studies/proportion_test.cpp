#include "studies/statistics/proportion.hpp"

#include <cmath>

#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

TEST(ProportionReference, IntervalsAreThoseOfTheIndependentComputation) {
  for (const nlohmann::json& row : expected()["clopper_pearson"]) {
    const auto ci = proportion(row["k"], row["n"]).ci95;
    EXPECT_NEAR(ci[0], row["ci95"][0].get<double>(), 1e-11) << row;
    EXPECT_NEAR(ci[1], row["ci95"][1].get<double>(), 1e-11) << row;
  }
}

// By definition: at the lower end k or more successes have 2.5 %, at the upper k or fewer.
TEST(Proportion, EndsHaveTheTailsThatTheyPromise) {
  for (const auto& [k, n] : {std::pair{3, 17}, std::pair{40, 41}, std::pair{1, 2}}) {
    const auto ci = clopper_pearson(static_cast<std::uint64_t>(k), static_cast<std::uint64_t>(n));
    const auto mass = [n = n](int i, double p) {
      return std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) +
                      i * std::log(p) + (n - i) * std::log1p(-p));
    };
    double above = 0.0, below = 0.0;
    for (int i = k; i <= n; ++i) above += mass(i, ci[0]);
    for (int i = 0; i <= k; ++i) below += mass(i, ci[1]);
    EXPECT_NEAR(above, 0.025, 1e-12);
    EXPECT_NEAR(below, 0.025, 1e-12);
  }
}

}  // namespace
}  // namespace frustum::studies
