#include "studies/statistics/conformity_risk.hpp"

#include <cmath>

#include "core/random.hpp"
#include "studies/engine/linear_engine.hpp"
#include "studies/laws/law.hpp"
#include "tests/law_count.hpp"
#include "tests/studies/populations.hpp"

namespace frustum::studies {
namespace {

TEST(ConformityRiskReference, NormalPriorsHaveTheRisksOfTheIndependentComputation) {
  for (const auto& [name, row] : expected()["jcgm106"].items()) {
    const nlohmann::json& a = row["args"];
    const Risks risks = risks_of_normal(a[0], a[1], a[2], {a[3], a[4]}, {a[5], a[6]});
    EXPECT_NEAR(risks.conform, row["p_conform"].get<double>(), 1e-10) << name;
    EXPECT_NEAR(risks.consumer, row["consumer"].get<double>(), 1e-10) << name;
    EXPECT_NEAR(risks.producer, row["producer"].get<double>(), 1e-10) << name;
    // Limits of 1500 are rounded to 6e-12 of u.
    EXPECT_NEAR(risks.accept, risks.conform - risks.producer + risks.consumer, 1e-11) << name;
  }
}

TEST(ConformityRiskReference, OnePartIsJudgedAsByTheIndependentComputation) {
  const nlohmann::json& rows = expected()["jcgm106_specific"];
  const ClosedInterval tolerance{.hi = 10.0};
  EXPECT_NEAR(conformance_probability(after_measuring(9.2, 0.6), tolerance),
              rows["flat prior, y 9.2 u .6 T 10"]["p_conform"].get<double>(), 1e-10);
  EXPECT_NEAR(acceptance_limit_for(0.95, 0.6, 10.0),
              rows["flat prior, acceptance limit for p_conform .95, u .6 T 10"]["A"].get<double>(),
              1e-10);
  const nlohmann::json& prior = rows["prior N(8,2), y 9.8 u .6 T 10"];
  const NormalBelief belief = after_measuring(9.8, 0.6, {8.0, 2.0});
  EXPECT_NEAR(belief.mean, prior["mean"].get<double>(), 1e-10);
  EXPECT_NEAR(belief.sd, prior["sd"].get<double>(), 1e-10);
  EXPECT_NEAR(conformance_probability(belief, tolerance), prior["p_conform"].get<double>(), 1e-10);
}

// Whole measurements, drawn: who is accepted and does not conform.
TEST(ConformityRisk, IsTheRateOfWrongDecisions) {
  constexpr std::uint64_t kParts = 400000;
  const ClosedInterval tolerance{-1.0, 2.0}, acceptance{-0.8, 1.9};
  std::uint64_t consumer = 0, producer = 0;
  for (std::uint64_t i = 0; i < kParts; ++i) {
    const double y = 0.5 + 1.2 * normal({1, 1}, i);
    const double measured = y + 0.3 * normal({1, 2}, i);
    if (acceptance.contains(measured) && !tolerance.contains(y)) ++consumer;
    if (!acceptance.contains(measured) && tolerance.contains(y)) ++producer;
  }
  const Risks risks = risks_of_normal(0.5, 1.2, 0.3, tolerance, acceptance);
  const auto slack = [](double p) { return 4.0 * std::sqrt(p / kParts); };
  EXPECT_NEAR(static_cast<double>(consumer) / kParts, risks.consumer, slack(risks.consumer));
  EXPECT_NEAR(static_cast<double>(producer) / kParts, risks.producer, slack(risks.producer));
}

TEST(ConformityRisk, SamplesConvergeToTheNormalPriorAndBeliefs) {
  std::vector<double> values(100000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 8.0 + 2.0 * normal({1, 1}, i);
  const ClosedInterval tolerance{.hi = 10.0}, acceptance{.hi = 9.5};
  const Risks sampled = risks_of_sample(values, 0.6, tolerance, acceptance);
  const Risks exact = risks_of_normal(8.0, 2.0, 0.6, tolerance, acceptance);
  EXPECT_NEAR(sampled.consumer, exact.consumer, 4.0 * sampled.consumer_se);
  EXPECT_NEAR(sampled.producer, exact.producer, 4.0 * sampled.producer_se);
  EXPECT_NEAR(conformance_probability(9.8, 0.6, values, tolerance),
              conformance_probability(after_measuring(9.8, 0.6, {8.0, 2.0}), tolerance), 0.01);
  // Far beyond all draws the nearest ones decide.
  EXPECT_NEAR(conformance_probability(90.0, 0.6, values, tolerance), 0.0, 1e-12);
}

TEST(ConformityRisk, RulesGiveLimitsOfAcceptance) {
  const auto rule = [](const char* text) { return *DecisionRule::parse(text); };
  std::vector<double> values(5000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 9.0 + normal({1, 3}, i);
  EXPECT_EQ(acceptance_limit(rule("simple"), values, 0.6, 10.0), 10.0);
  EXPECT_NEAR(acceptance_limit(rule("guard 1.0"), values, 0.6, 10.0), 8.8, 1e-12);
  const double a = acceptance_limit(rule("consumer 0.005"), values, 0.6, 10.0);
  EXPECT_NEAR(risks_of_sample(values, 0.6, {.hi = 10.0}, {.hi = a}).consumer, 0.005, 1e-9);
  for (const char* wrong :
       {"guard", "guard x", "consumer 0", "consumer 1.5", "none 3", "simple 1"}) {
    EXPECT_FALSE(DecisionRule::parse(wrong)) << wrong;
  }
}

TEST(ConformityRiskReference, RisksOfTheConeAreThoseOfTheIndependentComputation) {
  const std::uint32_t draws = proof::law_count<std::uint32_t>(524288, 32768);
  for (const auto& [key, row] : expected()["risk_cone"].items()) {
    if (proof::laws_are_reduced() && key != "proposed/R") continue;
    const RingPopulation& p =
        RingPopulation::of(key.substr(0, key.find('/')) + "/cone", key.back());
    const std::vector<std::uint64_t> streams = p.set.streams();
    auto values = LinearEngine(p.set, p.model)
                      .evaluate(*Scheme::make(SchemeKind::random, 1, streams), 1, 0, draws);
    values.resize(draws);
    for (const auto& [name, rule] :
         {std::pair{"simple", "simple"}, std::pair{"guarded, w = U", "guard 1.0"},
          std::pair{"guarded rejection, w = -U", "guard -1.0"}}) {
      const double a = acceptance_limit(*DecisionRule::parse(rule), values, 0.6, 10.0);
      EXPECT_NEAR(a, row[name]["limit"].get<double>(), 1e-12);
      const Risks risks = risks_of_sample(values, 0.6, {.hi = 10.0}, {.hi = a});
      // All draws: forms are the same to 1e-3 um; fewer: four standard errors.
      const double in_full = draws == 524288 ? 1.0 : 0.0;
      const auto slack = [&](double se) {
        return in_full * 1e-6 * 20 + (1.0 - in_full) * 4.0 * se;
      };
      EXPECT_NEAR(risks.consumer, row[name]["consumer"].get<double>(), slack(risks.consumer_se));
      EXPECT_NEAR(risks.producer, row[name]["producer"].get<double>(), slack(risks.producer_se));
      if (draws == 524288) {
        EXPECT_NEAR(risks.consumer_se, row[name]["consumer_se"].get<double>(), 1e-6);
        EXPECT_NEAR(risks.producer_se, row[name]["producer_se"].get<double>(), 1e-6);
      }
    }
    if (draws < 200000) continue;
    const std::span<const double> first = std::span(values).first(200000);
    EXPECT_NEAR(acceptance_limit(*DecisionRule::parse("consumer 0.005"), first, 0.6, 10.0),
                row["limit_for_consumer_0.005"]["A"].get<double>(), 1e-3);
  }
}

}  // namespace
}  // namespace frustum::studies
