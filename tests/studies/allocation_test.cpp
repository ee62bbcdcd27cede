#include "studies/answers/allocation.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"
#include "studies/answers/shares.hpp"
#include "studies/engine/linear_engine.hpp"
#include "tests/law_count.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

TEST(AllocationReference, ClosedFormIsThatOfTheIndependentComputation) {
  const nlohmann::json& row = expected()["allocation"]["closed form"];
  const std::vector<double> gains = row["gains"], costs = row["costs"];
  const AllowedTolerances allowed = closed_form_tolerances(gains, costs, row["sd_allowed"]);
  for (std::size_t j = 0; j < gains.size(); ++j) {
    EXPECT_NEAR(allowed.limits[j], row["limits"][j].get<double>(), 1e-9);
  }
  EXPECT_NEAR(allowed.cost, row["cost"].get<double>(), 1e-9);
}

// The search knows nothing of the closed form; values are normal with known gains.
TEST(Allocation, FindsTheClosedFormOfASumOfSquares) {
  const std::vector<double> gains{1.0, 1.46, 1.26}, costs{1.0, 3.0, 2.0};
  constexpr std::size_t kDraws = 200001;
  const ScaledValues values = [&](std::span<const double> factors) {
    double square = 0.0;
    for (std::size_t g = 0; g < 3; ++g) square += std::pow(gains[g] * factors[g], 2);
    std::vector<double> drawn(kDraws);
    // |x| of a normal law at its quantiles: no scatter.
    for (std::size_t i = 0; i < kDraws; ++i) {
      drawn[i] = std::sqrt(square) * static_cast<double>(i) / kDraws;
    }
    return drawn;
  };
  const Allocation found = allocate(values, costs, 0.95, 4.0);
  const double deviation = 4.0 / 0.95;
  const AllowedTolerances exact = closed_form_tolerances(gains, costs, deviation / 3.0);
  EXPECT_NEAR(found.cost, exact.cost, 1e-4 * exact.cost);
  for (std::size_t g = 0; g < 3; ++g) EXPECT_NEAR(found.factors[g], exact.limits[g], 0.01);
  EXPECT_LT(found.cost, found.equal_cost);
}

TEST(AllocationReference, FactorsOfTheConeAreThoseOfTheIndependentComputation) {
  const std::uint32_t draws = proof::law_count<std::uint32_t>(524288, 1000);
  for (const char* key : {"proposed/R", "proposed/A", "comparison/R", "comparison/A"}) {
    if (proof::laws_are_reduced() && std::string(key) != "proposed/R") continue;
    const std::string name = key;
    const RingPopulation& p =
        RingPopulation::of(name.substr(0, name.find('/')) + "/cone", name.back());
    LinearModel form = p.model;
    form.characteristics.resize(1);
    const LinearEngine engine(p.set, form);
    const std::vector<std::uint64_t> streams = p.set.streams();
    auto sorted = engine.evaluate(*Scheme::make(SchemeKind::random, 1, streams), 1, 0, draws);
    std::sort(sorted.begin(), sorted.end());
    const OneFactor one = one_factor(sorted, 0.95, 10.0);
    const nlohmann::json& row = expected()["allocation"][name + ": one factor, P(form<=10)=.95"];
    if (draws == 524288) {
      EXPECT_NEAR(one.factor, row["factor"].get<double>(), 1e-4);
      EXPECT_NEAR(*one.ci95.lo, row["ci95"][0].get<double>(), 1e-4);
      EXPECT_NEAR(*one.ci95.hi, row["ci95"][1].get<double>(), 1e-4);
    } else {
      const nlohmann::json& quantiles = expected()["cone"]["proposed/cone"]["R"]["1000"];
      EXPECT_NEAR(one.factor, 10.0 / quantiles["q95"].get<double>(), 1e-4);
      EXPECT_NEAR(*one.ci95.lo, 10.0 / quantiles["q95_ci95"][1].get<double>(), 1e-4);
      EXPECT_NEAR(*one.ci95.hi, 10.0 / quantiles["q95_ci95"][0].get<double>(), 1e-4);
    }
  }
}

// Three groups on the draws of the independent computation. Costs agree; factors need not.
TEST(AllocationLaws, CostOfThreeGroupsIsThatOfTheIndependentComputation) {
  const auto draws = proof::law_count<std::uint32_t>(16384, 2048);
  const kinematics::Machine machine = machine_named("iwf-bc");
  for (const char read : {'R', 'A'}) {
    const RingPopulation& p = RingPopulation::of("proposed/cone", read);
    const auto groups = groups_named(
        machine, p.set,
        {{"1 location", {"E?0?"}},
         {"2 linear axes",
          {"E?X", "E?Y:linear", "E?Y:harmonic", "E?Y:reversal", "E?Y:cyclic", "E?Z:linear",
           "E?Z:harmonic", "E?Z:reversal", "E?Z:cyclic"}},
         {"3 rotary axes", {"E?B:linear", "E?B:harmonic", "E?B:reversal", "E?C:harmonic"}}});
    ASSERT_TRUE(groups) << to_string(groups.error().front());
    ASSERT_EQ(groups->size(), 3U);
    LinearModel form = p.model;
    form.characteristics.resize(1);
    const LinearEngine engine(p.set, form);
    const std::size_t columns = p.set.columns().size();
    std::vector<std::size_t> group_of(columns, 0);
    for (std::size_t g = 0; g < 3; ++g) {
      for (const std::size_t f : (*groups)[g].factors) {
        for (const std::size_t j : p.set.factors()[f].columns) group_of[j] = g;
      }
    }
    std::vector<double> drawn;
    for (std::uint32_t d = 0; d < draws; ++d) {
      const Eigen::VectorXd w = p.weights(1, d);
      drawn.insert(drawn.end(), w.data(), w.data() + w.size());
    }
    const ScaledValues values = [&](std::span<const double> factors) {
      std::vector<double> scaled = drawn;
      for (std::size_t i = 0; i < scaled.size(); ++i) scaled[i] *= factors[group_of[i % columns]];
      return engine.evaluate_weights(scaled);
    };
    const Allocation found = allocate(values, std::vector<double>(3, 1.0), 0.95, 10.0);
    const nlohmann::json& row =
        expected()["allocation"][std::string("proposed/") + read + ": three groups, cost 1/s each"];
    // 1 %; of fewer draws the quantile scatters more.
    const double slack = draws == 16384 ? 0.01 : 0.05;
    EXPECT_NEAR(found.cost / row["cost"].get<double>(), 1.0, slack);
    EXPECT_NEAR(found.equal_cost / row["cost_equal_factor"].get<double>(), 1.0, slack);
    EXPECT_LT(found.cost, 0.995 * found.equal_cost);
    EXPECT_LE(found.cost, row["cost"].get<double>() * (draws == 16384 ? 1.0005 : 1.05));
  }
}

}  // namespace
}  // namespace frustum::studies
