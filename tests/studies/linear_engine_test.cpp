#include "studies/engine/linear_engine.hpp"

#include <tbb/global_control.h>

#include <cmath>
#include <cstring>

#include "studies/statistics/order_statistics.hpp"
#include "studies/statistics/summary.hpp"
#include "tests/law_count.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

Scheme random_scheme(const FactorSet& set, SchemeKind kind = SchemeKind::random) {
  const std::vector<std::uint64_t> streams = set.streams();
  return *Scheme::make(kind, 1, streams);
}

TEST(LinearEngine, EqualsTheEvaluationOfEveryPoint) {
  for (const char* place : {"proposed/cone", "comparison/cylinder"}) {
    const RingPopulation& population = RingPopulation::of(place, 'A');
    const LinearEngine engine(population.set, population.model);
    constexpr std::uint32_t kDraws = 700;  // no multiple of the lanes
    const auto values = engine.evaluate(random_scheme(population.set), 1, 0, kDraws);
    ASSERT_EQ(values.size(), kDraws * population.model.characteristics.size());
    for (std::uint32_t d = 0; d < kDraws; ++d) {
      const Eigen::VectorXd w = population.weights(1, d);
      for (std::size_t c = 0; c < population.model.characteristics.size(); ++c) {
        // Sums of a hundred products in another order.
        EXPECT_NEAR(values[c * kDraws + d], value_of(population.model.characteristics[c], w), 1e-12)
            << place << d;
      }
    }
  }
}

// The same points as other sizes: rows, the farthest point, vectors.
TEST(LinearEngine, EqualsTheEvaluationOfEveryPointForEverySize) {
  const RingPopulation& population = RingPopulation::of("proposed/cone", 'A');
  const auto& range = std::get<LinearRange>(population.model.characteristics[0].of);
  LinearRange rows = range;
  rows.rows = {100, 1, 200, 59};
  const LinearModel model{{{"rows", "um", rows},
                           {"reach", "um", LinearReach{2.0, range.nominal, range.gains}},
                           {"length", "um", LinearLength{2.0, 3, range.nominal, range.gains}}}};
  const LinearEngine engine(population.set, model);
  constexpr std::uint32_t kDraws = 333;
  const auto values = engine.evaluate(random_scheme(population.set), 1, 0, kDraws);
  for (std::uint32_t d = 0; d < kDraws; ++d) {
    const Eigen::VectorXd w = population.weights(1, d);
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(values[c * kDraws + d], value_of(model.characteristics[c], w), 1e-12)
          << model.characteristics[c].name << d;
    }
  }
}

TEST(LinearEngine, GivesTheSameBitsInAnyLaneBlockAndThreadWithAndWithoutAvx2) {
  const RingPopulation& population = RingPopulation::of("proposed/cone", 'R');
  const LinearEngine engine(population.set, population.model);
  const LinearEngine plain(population.set, population.model, Lanes::plain);
  const Scheme scheme = random_scheme(population.set);
  constexpr std::uint32_t kDraws = 2500;
  const auto all = engine.evaluate(scheme, 1, 0, kDraws);
  EXPECT_EQ(all, plain.evaluate(scheme, 1, 0, kDraws));
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(all, engine.evaluate(scheme, 1, 0, kDraws));
  }
  const auto part = engine.evaluate(scheme, 1, 1237, 21);
  for (std::size_t d = 0; d < 21; ++d) EXPECT_EQ(part[d], all[1237 + d]);
  // Through values of variables and through weights.
  std::vector<double> values, weights;
  for (std::uint32_t d = 0; d < 40; ++d) {
    std::vector<double> v(population.set.variables().size());
    population.set.draw(1, d, v);
    values.insert(values.end(), v.begin(), v.end());
    const Eigen::VectorXd w = population.weights(1, d);
    weights.insert(weights.end(), w.data(), w.data() + w.size());
  }
  const auto by_values = engine.evaluate_values(values);
  const auto by_weights = engine.evaluate_weights(weights);
  for (std::size_t d = 0; d < 40; ++d) {
    EXPECT_EQ(by_values[d], all[d]);
    EXPECT_EQ(by_weights[d], all[d]);
  }
}

TEST(LinearEngineReference, ScreensHaveTheColumnsOfTheIndependentComputation) {
  for (const char* place :
       {"proposed/cone", "proposed/cylinder", "comparison/cone", "comparison/cylinder"}) {
    const RingPopulation& population = RingPopulation::of(place, 'A');
    const LinearEngine engine(population.set, population.model);
    EXPECT_EQ(engine.screen(0).columns,
              expected()["kernel"][place]["live_1e_6um"].get<std::size_t>());
    EXPECT_LT(engine.screen(0).left_out, 0.01);
    EXPECT_LE(engine.screen(0).rank, 44U);
  }
}

// Quantiles of all draws of the independent computation: 1,000 in the reduced run.
TEST(LinearEngineReference, QuantilesAreThoseOfTheIndependentComputation) {
  const std::uint32_t draws = proof::law_count<std::uint32_t>(524288, 1000);
  for (const char* place :
       {"proposed/cone", "proposed/cylinder", "comparison/cone", "comparison/cylinder"}) {
    for (const char read : {'A', 'R'}) {
      const RingPopulation& population = RingPopulation::of(place, read);
      const LinearEngine engine(population.set, population.model);
      const auto values = engine.evaluate(random_scheme(population.set), 1, 0, draws);
      const Summary summary = summary_of(std::span(values).first(draws));
      const nlohmann::json& numbers =
          expected()["cone"][place][std::string(1, read)][std::to_string(draws)];
      EXPECT_NEAR(summary.mean, numbers["mean"].get<double>(), 1e-3);
      EXPECT_NEAR(summary.mean_se, numbers["mean_se"].get<double>(), 1e-4);
      EXPECT_NEAR(summary.min, numbers["min"].get<double>(), 1e-3);
      EXPECT_NEAR(summary.max, numbers["max"].get<double>(), 1e-3);
      for (const auto& [p, name] :
           {std::pair{0.05, "q05"}, std::pair{0.25, "q25"}, std::pair{0.5, "q50"},
            std::pair{0.75, "q75"}, std::pair{0.95, "q95"}, std::pair{0.99, "q99"}}) {
        for (const QuantileEstimate& q : summary.quantiles) {
          if (q.p != p) continue;
          EXPECT_NEAR(q.value, numbers[name].get<double>(), 1e-3) << place << read << name;
          const auto& interval = numbers[std::string(name) + "_ci95"];
          EXPECT_NEAR(*q.ci95.lo, interval[0].get<double>(), 1e-3);
          EXPECT_NEAR(*q.ci95.hi, interval[1].get<double>(), 1e-3);
        }
      }
    }
  }
}

}  // namespace
}  // namespace frustum::studies
