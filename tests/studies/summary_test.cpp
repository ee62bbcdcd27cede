#include "studies/statistics/summary.hpp"

#include <cmath>

#include "core/random.hpp"
#include "studies/engine/linear_engine.hpp"
#include "tests/law_count.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

std::vector<double> random_values(std::size_t n) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = 1e3 + normal({1, 0}, i);
  return values;
}

TEST(Summary, SumsAreThoseOfBlocksInTheirOrder) {
  const std::vector<double> values = random_values(3 * kSumBlock + 77);
  double sum = 0.0;
  for (std::size_t first = 0; first < values.size(); first += kSumBlock) {
    const std::size_t count = std::min(kSumBlock, values.size() - first);
    sum += ordered_sum(std::span(values).subspan(first, count));
  }
  EXPECT_EQ(ordered_sum(values), sum);
  long double exact = 0.0L;
  for (const double v : values) exact += v;
  EXPECT_NEAR(ordered_sum(values), static_cast<double>(exact), 1e-6);
}

TEST(Summary, GroupsGiveIntervalsFromTheirScatter) {
  constexpr std::size_t kDraws = 16 * 300;
  const std::vector<double> values = random_values(kDraws);
  std::vector<std::uint32_t> groups(kDraws);
  for (std::uint32_t i = 0; i < kDraws; ++i) groups[i] = i % 16;
  const Summary of_groups = summary_of(values, kQuantiles, groups);
  const Summary plain = summary_of(values);
  EXPECT_EQ(of_groups.mean, plain.mean);
  // Independent draws: the scatter of 16 groups is the standard error, give or take 20 %.
  EXPECT_NEAR(of_groups.mean_se / plain.mean_se, 1.0, 0.6);
  for (std::size_t q = 0; q < plain.quantiles.size(); ++q) {
    EXPECT_EQ(of_groups.quantiles[q].value, plain.quantiles[q].value);
    EXPECT_NEAR(*half_width(of_groups.quantiles[q].ci95) / *half_width(plain.quantiles[q].ci95),
                1.0, 0.7);
  }
  EXPECT_NEAR(student_95(15), 2.131449545559323, 1e-12);
  EXPECT_FALSE(scatter(1.0, std::vector<double>{1.0}).ci95.lo);
}

TEST(Summary, StopsAreLookedAtAtPowersOfTwo) {
  EXPECT_TRUE(is_stop_count(4096));
  EXPECT_TRUE(is_stop_count(65536));
  EXPECT_FALSE(is_stop_count(2048));
  EXPECT_FALSE(is_stop_count(4096 * 3));
}

// Conforming draws of the independent computation, and where its stop rules stop.
TEST(SummaryReference, ConformityAndStopsAreThoseOfTheIndependentComputation) {
  const bool in_full = !proof::laws_are_reduced();
  const std::uint32_t draws = in_full ? 524288 : 1000;
  for (const char* setup : {"proposed", "comparison"}) {
    for (const char read : {'A', 'R'}) {
      const std::string key = std::string(setup) + "/" + read;
      const auto values_of = [&](const char* part) {
        const RingPopulation& p = RingPopulation::of(std::string(setup) + "/" + part, read);
        const std::vector<std::uint64_t> streams = p.set.streams();
        return LinearEngine(p.set, p.model)
            .evaluate(*Scheme::make(SchemeKind::random, 1, streams), 1, 0, draws);
      };
      const std::vector<double> cone = values_of("cone"), cylinder = values_of("cylinder");
      const std::span<const double> forms = std::span(cone).first(draws);
      const std::span<const double> angles = std::span(cone).subspan(draws);
      const nlohmann::json& rows = expected()["acceptance"][key];
      const char* count = in_full ? "k" : "k_first_1000";
      // A draw within 1e-3 um of the limit may fall on either side: one in 10,000.
      const double slack = in_full ? 60.0 : 0.0;
      const auto near = [&](const Proportion& p, const char* row) {
        EXPECT_NEAR(static_cast<double>(p.k), rows[row][count].get<double>(), slack) << key << row;
      };
      near(conforming(forms, 10.0), "cone form <= 10");
      near(conforming(cylinder, 10.0), "cylinder <= 10");
      near(conforming_both_sides(angles, 60.0), "half angle <= 60 urad");
      if (!in_full) continue;
      for (const auto& [p, goal, name] :
           {std::tuple{0.5, 0.05, "/q50<=0.05"}, std::tuple{0.95, 0.1, "/q95<=0.1"}}) {
        std::uint32_t n = 4096;
        for (; n < draws; n *= 2) {
          std::vector<double> sorted(forms.begin(), forms.begin() + n);
          std::sort(sorted.begin(), sorted.end());
          if (*half_width(quantile_interval(sorted, p)) <= goal) break;
        }
        EXPECT_EQ(n, expected()["stop"][key + name]["stops_at"].get<std::uint32_t>());
      }
    }
  }
}

}  // namespace
}  // namespace frustum::studies
