#include "studies/answers/shares.hpp"

#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "studies/engine/linear_engine.hpp"
#include "studies/laws/law.hpp"
#include "tests/law_count.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

// Groups of the independent computation, as patterns.
std::map<std::string, std::vector<std::string>> published_groups() {
  return {{"X straight", {"EYX", "EZX", "EXX:linear", "EXX:cyclic"}},
          {"Y straight", {"EXY", "EZY", "EYY:linear", "EYY:cyclic"}},
          {"Z straight", {"EXZ", "EYZ", "EZZ:linear", "EZZ:cyclic"}},
          {"X angular", {"EAX", "EBX", "ECX"}},
          {"Y angular", {"EAY", "EBY", "ECY"}},
          {"Z angular", {"EAZ", "EBZ", "ECZ"}},
          {"hysteresis", {"*:reversal"}},
          {"location", {"E?0?"}},
          {"B axis", {"E?B:linear", "E?B:harmonic"}},
          {"C axis", {"E?C:harmonic"}}};
}

TEST(SharesReference, MeanSquaresAreThoseOfTheIndependentComputation) {
  const kinematics::Machine machine = machine_named("iwf-bc");
  for (const auto& [key, numbers] : expected()["shares_mean_square"].items()) {
    const RingPopulation& p =
        RingPopulation::of(key.substr(0, key.find('/')) + "/cone", key.back());
    const auto groups = groups_named(machine, p.set, published_groups());
    ASSERT_TRUE(groups) << to_string(groups.error().front());
    const MeanSquareShares shares = mean_square_shares(p.gains, p.set, *groups);
    EXPECT_NEAR(shares.mean_square, numbers["mean_square"].get<double>(), 1e-4) << key;
    double sum = 0.0;
    for (std::size_t g = 0; g < groups->size(); ++g) {
      EXPECT_NEAR(shares.shares[g], numbers["groups"][(*groups)[g].name].get<double>(), 1e-5)
          << key << (*groups)[g].name;
      sum += shares.shares[g];
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    const auto entries = groups_by_entry(p.set);
    const MeanSquareShares of_entries = mean_square_shares(p.gains, p.set, entries);
    for (std::size_t g = 0; g < entries.size(); ++g) {
      const nlohmann::json& known = numbers["entries"];
      if (known.contains(entries[g].name)) {
        EXPECT_NEAR(of_entries.shares[g], known[entries[g].name].get<double>(), 1e-5);
      }
    }
  }
}

TEST(Shares, GroupsNameEveryErrorOnceAndSayWhatTheyMiss) {
  const kinematics::Machine machine = machine_named("iwf-bc");
  const FactorSet& set = RingPopulation::of("proposed/cone", 'A').set;
  const auto id = [&](const std::map<std::string, std::vector<std::string>>& patterns) {
    const auto groups = groups_named(machine, set, patterns);
    return groups ? DiagnosticId{} : groups.error().front().id;
  };
  EXPECT_EQ(id({{"a", {"EXX"}}, {"b", {"EX*"}}}), "group-twice"_id);
  EXPECT_EQ(id({{"a", {"EX0A"}}}), "group-error"_id);
  const auto groups = groups_named(machine, set, {{"table", {"E*B", "E*C"}}});
  ASSERT_TRUE(groups);
  ASSERT_EQ(groups->size(), 2U);
  EXPECT_EQ((*groups)[1].name, "rest");
  EXPECT_EQ((*groups)[0].factors.size() + (*groups)[1].factors.size(), set.factors().size());
}

// Indices of functions whose indices are known in closed form.
SobolIndices indices_of(std::size_t variables, std::uint32_t draws,
                        const std::function<double(std::span<const double>)>& f) {
  std::vector<std::vector<std::size_t>> each;
  for (std::size_t v = 0; v < variables; ++v) each.push_back({v});
  return sobol_indices(
      variables, each, draws,
      [](bool b, std::uint32_t d, std::span<double> values) {
        for (std::size_t v = 0; v < values.size(); ++v) {
          values[v] = uniform({b ? 2U : 1U, d, RandomPurpose::test_data}, v);
        }
      },
      [&](std::span<const double> values, std::span<double> results) {
        for (std::size_t d = 0; d < results.size(); ++d) {
          results[d] = f(values.subspan(d * variables, variables));
        }
      });
}

void expect_indices(const SobolIndices& found, const nlohmann::json& exact, const char* name) {
  for (std::size_t g = 0; g < found.groups.size(); ++g) {
    const SobolIndex& index = found.groups[g];
    EXPECT_NEAR(index.first, exact["first"][g].get<double>(), 4.0 * index.first_se + 1e-12) << name;
    EXPECT_NEAR(index.total, exact["total"][g].get<double>(), 4.0 * index.total_se + 1e-12) << name;
    EXPECT_LT(index.total_se, 0.02);
  }
}

TEST(SharesReference, IndicesOfKnownFunctionsAreTheirs) {
  const nlohmann::json& exact = expected()["shares_exact"];
  constexpr std::uint32_t kDraws = 16384;
  const std::vector<double> gains = exact["linear"]["gains"],
                            widths = exact["linear"]["half_widths"];
  const SobolIndices linear = indices_of(4, kDraws, [&](std::span<const double> u) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) sum += gains[i] * widths[i] * (2.0 * u[i] - 1.0);
    return sum;
  });
  expect_indices(linear, exact["linear"], "linear");
  EXPECT_NEAR(linear.variance, exact["linear"]["variance"].get<double>(), 0.2);
  expect_indices(indices_of(2, kDraws, [](auto u) { return std::max(u[0], u[1]); }),
                 exact["max of two uniforms (0,1)"], "max");
  expect_indices(indices_of(2, kDraws,
                            [](auto u) {
                              return 2.0 * std::hypot(normal_quantile(u[0]), normal_quantile(u[1]));
                            }),
                 exact["form of a second harmonic, a and b ~ N(0,1)"], "second harmonic");
  expect_indices(indices_of(3, kDraws,
                            [](auto u) {
                              const auto x = [&](int i) {
                                return std::numbers::pi *
                                       (2.0 * u[static_cast<std::size_t>(i)] - 1.0);
                              };
                              return std::sin(x(0)) + 7.0 * std::pow(std::sin(x(1)), 2) +
                                     0.1 * std::pow(x(2), 4) * std::sin(x(0));
                            }),
                 exact["Ishigami 7, 0.1"], "Ishigami");
}

TEST(SharesReference, TotalsOfTheConeAreThoseOfTheIndependentComputation) {
  const auto draws = proof::law_count<std::uint32_t>(32768, 4096);
  const kinematics::Machine machine = machine_named("iwf-bc");
  for (const auto& [key, numbers] : expected()["shares_table39"].items()) {
    if (proof::laws_are_reduced() && key != "proposed/R") continue;
    const RingPopulation& p =
        RingPopulation::of(key.substr(0, key.find('/')) + "/cone", key.back());
    const auto groups = groups_named(machine, p.set, published_groups());
    ASSERT_TRUE(groups);
    LinearModel form = p.model;
    form.characteristics.resize(1);
    const LinearEngine engine(p.set, form);
    for (const std::uint64_t seed : {1U, 2U}) {
      const SobolIndices indices = sobol_indices(
          p.set, *groups, seed, draws, [&](std::span<const double> v, std::span<double> results) {
            const auto values = engine.evaluate_values(v);
            std::copy(values.begin(), values.end(), results.begin());
          });
      for (std::size_t g = 0; g < groups->size(); ++g) {
        const nlohmann::json& row = numbers["groups"][(*groups)[g].name];
        const SobolIndex& index = indices.groups[g];
        const auto slack = [](double a, double b) { return 4.0 * std::hypot(a, b) + 1e-9; };
        EXPECT_NEAR(index.total, row["total"].get<double>(),
                    slack(index.total_se, row["total_se"].get<double>()))
            << key << (*groups)[g].name;
        EXPECT_NEAR(index.first, row["first"].get<double>(),
                    slack(index.first_se, row["first_se"].get<double>()))
            << key << (*groups)[g].name;
      }
    }
  }
}

}  // namespace
}  // namespace frustum::studies
