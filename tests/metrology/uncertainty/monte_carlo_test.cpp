#include "metrology/uncertainty/monte_carlo_uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "metrology/decision_rule.hpp"
#include "metrology/uncertainty/non_negative_interval.hpp"
#include "metrology/uncertainty/refit.hpp"
#include "tests/metrology/step_part.hpp"
#include "tests/metrology/synthetic.hpp"
#include "tests/metrology/test_part.hpp"

namespace frustum::metrology {
namespace {

const CmmModel kCmm{.e0_mm = 0.002, .length_per_error = 300.0, .seed = 7};

Measurement measured_with_draws(InspectionPlan plan, const CmmModel& cmm, std::size_t draws) {
  plan.monte_carlo = MonteCarloSettings{.draws = draws};
  auto m = measure(plan, test_part::part({.lobe = 0.004}), cmm);
  EXPECT_TRUE(m) << (m ? "" : to_string(m.error().front()));
  return m ? *m : Measurement{};
}

TEST(Refit, AgreesWithTheSearchFromScratch) {
  synthetic::Draws draws(31);
  for (const std::size_t which : {std::size_t{1}, std::size_t{3}}) {  // cylinder, cone
    const PlannedFeature planned = test_part::plan().features[which];
    const Pose lie{rotation_about(draws.direction(), 0.01), draws.place(0.3)};
    std::vector<Vec3> points;
    std::vector<std::size_t> sections;
    for (const PlannedPoint& p : planned_points(planned)) {
      points.push_back(lie.point(p.point));
      sections.push_back(p.section);
    }
    const auto known = fit_feature(planned, points, sections, 0.0);
    ASSERT_TRUE(known);
    for (Vec3& p : points) p += 0.005 * Vec3(draws.gauss(), draws.gauss(), draws.gauss());
    const auto near = refit(*known, points);
    const auto searched = fit_feature(planned, points, sections, 0.0);
    ASSERT_TRUE(near && searched);
    EXPECT_NEAR(near->form, searched->form, 1e-9);
    EXPECT_NEAR(near->rms, searched->rms, 1e-9);
    EXPECT_LT((axis_of(near->element)->vec() - axis_of(searched->element)->vec()).norm(), 1e-10);
    for (std::size_t i = 0; i < points.size(); ++i) {
      EXPECT_NEAR(near->points[i].deviation, searched->points[i].deviation, 1e-9);
    }
  }
}

TEST(MonteCarlo, AgreesWithLinearPropagationWhereThatHolds) {
  const Measurement m = measured_with_draws(test_part::plan(), kCmm, 10000);
  for (const char* name : {"cone.half_angle", "cylinder.diameter"}) {
    const CharacteristicResult& c = m.characteristics[*m.find(name)];
    ASSERT_TRUE(c.simulated);
    EXPECT_EQ(c.simulated->draws, 10000U);
    // A standard deviation of 10,000 draws has a standard error of 0.7 %.
    EXPECT_NEAR(2.0 * c.simulated->standard / c.expanded_uncertainty, 1.0, 0.03) << name;
    EXPECT_NEAR((c.simulated->high - c.simulated->low) / (2.0 * 1.96 * c.simulated->standard), 1.0,
                0.03)
        << name;
    EXPECT_NEAR(c.simulated->high + c.simulated->low, 2.0 * c.value, 0.1 * c.expanded_uncertainty)
        << name;
  }
  // A true form of 8 um, seen larger for the noise.
  const CharacteristicResult& form = m.characteristics[*m.find("cone.form")];
  EXPECT_GT(form.value, 9.0);
  EXPECT_LT(form.simulated->low, 8.0);
  EXPECT_GT(form.simulated->high, 8.0);
  EXPECT_LT(form.simulated->high, form.value);
  // No form at all.
  const CharacteristicResult& flatness = m.characteristics[*m.find("A.flatness")];
  EXPECT_EQ(flatness.simulated->low, 0.0);
  EXPECT_GT(flatness.simulated->high, 0.0);
}

TEST(MonteCarlo, RepeatsItselfAndMovesNothingElse) {
  InspectionPlan plan = step_part::plan();
  const auto linear = measure(plan, step_part::part(), kCmm);
  plan.monte_carlo = MonteCarloSettings{};
  const auto first = measure(plan, step_part::part(), kCmm);
  const auto again = measure(plan, step_part::part(), kCmm);
  plan.monte_carlo->seed = 2;
  const auto other = measure(plan, step_part::part(), kCmm);
  ASSERT_TRUE(linear && first && again && other);
  for (std::size_t i = 0; i < linear->characteristics.size(); ++i) {
    const CharacteristicResult& c = first->characteristics[i];
    EXPECT_FALSE(linear->characteristics[i].simulated);
    EXPECT_EQ(c.value, linear->characteristics[i].value);
    // One statement: U is that of the interval.
    EXPECT_EQ(c.expanded_uncertainty,
              std::max(c.value - c.simulated->low, c.simulated->high - c.value));
    ASSERT_TRUE(c.simulated);
    EXPECT_TRUE(c.simulated->stable) << c.name;
    EXPECT_GE(c.simulated->draws, 10000U);
    EXPECT_EQ(c.simulated->low, again->characteristics[i].simulated->low);
    EXPECT_EQ(c.simulated->high, again->characteristics[i].simulated->high);
    EXPECT_NE(c.simulated->low, other->characteristics[i].simulated->low);
    EXPECT_NEAR(2.0 * c.simulated->standard / c.expanded_uncertainty, 1.0, 0.03) << c.name;
  }
}

TEST(MonteCarlo, IsNotAskedOfAnIdealMachine) {
  const Measurement m = measured_with_draws(test_part::plan(), {}, 10000);
  for (const CharacteristicResult& c : m.characteristics) EXPECT_FALSE(c.simulated);
}

TEST(MonteCarlo, ReadsAndWritesItsSettings) {
  InspectionPlan plan = test_part::plan();
  plan.monte_carlo = MonteCarloSettings{.draws = 50000, .digits = 2, .seed = 9};
  plan.decision = DecisionRule::iso14253;
  const auto back = parse_plan(to_toml(plan));
  ASSERT_TRUE(back) << to_string(back.error().front());
  EXPECT_EQ(*back, plan);
  const auto refusal = [&](const std::string& line) {
    const auto read = parse_plan(line + "\n" + to_toml(test_part::plan()), "plan.toml");
    return read ? std::string() : to_string(read.error().front());
  };
  EXPECT_NE(refusal("uncertainty = { method = \"monte\" }").find("uncertainty.method"),
            std::string::npos);
  EXPECT_NE(refusal("uncertainty = { method = \"monte_carlo\", digits = 3 }")
                .find("must be 1 or 2, is 3"),
            std::string::npos);
  EXPECT_NE(refusal("uncertainty = { method = \"monte_carlo\", draw = 3 }").find("draws"),
            std::string::npos);
  for (const char* key : {"draws = 4000", "digits = 2", "seed = 3"}) {
    const std::string told =
        refusal("uncertainty = { method = \"linear\", " + std::string(key) + " }");
    const std::string name(key, std::string_view(key).find(' '));
    EXPECT_NE(told.find("uncertainty." + name + ": belongs to method = \"monte_carlo\""),
              std::string::npos)
        << told;
  }
  EXPECT_EQ(refusal("uncertainty = { method = \"linear\" }"), "");
  EXPECT_NE(refusal("decision = \"iso\"").find("iso14253"), std::string::npos);
}

TEST(MagnitudeInterval, SplitsTheTailsByTheLikelihoodRatio) {
  EXPECT_NEAR(tails_near_zero(0.0, 0.95).low, 0.0, 1e-12);
  EXPECT_NEAR(tails_near_zero(0.0, 0.95).high, 0.05, 1e-9);
  EXPECT_NEAR(tails_near_zero(8.0, 0.95).low, 0.025, 1e-9);
  // Feldman, Cousins 1998, table X: a measured mean of 1.0 has the upper limit 2.96, so a true mean
  // of 2.96 accepts from 1.0 on.
  EXPECT_NEAR(tails_near_zero(2.96, 0.95).low, 0.5 * std::erfc(1.96 / std::sqrt(2.0)), 0.001);
  // Where the lower end is negative its best mean is 0: equal likelihood ratios at both ends.
  const Tails tails = tails_near_zero(0.5, 0.95);
  EXPECT_NEAR(tails.low + tails.high, 0.05, 1e-12);
  const auto end = [](double tail) {  // a normal value is beyond it with that probability
    double below = 0.0;
    double above = 10.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (below + above);
      (0.5 * std::erfc(middle / std::sqrt(2.0)) > tail ? below : above) = middle;
    }
    return below;
  };
  const double low = 0.5 - end(tails.low);
  const double high = 0.5 + end(tails.high);
  ASSERT_LT(low, 0.0);
  EXPECT_NEAR(low * 0.5 - 0.5 * 0.5 * 0.5, -0.5 * (high - 0.5) * (high - 0.5), 1e-6);
}

TEST(MagnitudeInterval, IsTheMeasuredSizeWithoutNoise) {
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(3, 100);
  const Eigen::VectorXd shape = ShapeEstimate({NonNegativeKind::length}, {}, none)(Vec3(3, 0, 4));
  EXPECT_NEAR(shape[0], 0.6, 1e-12);
  const SizeInterval found = SizeUnderNoise({NonNegativeKind::length}, none, shape).interval(5.0);
  EXPECT_EQ(found.low, 5.0);
  EXPECT_EQ(found.high, 5.0);
}

TEST(DecisionRule, PassesWithinFailsBeyondAndElseDoesNotKnow) {
  CharacteristicResult c;
  c.nominal = 10.0;
  c.tolerance = 1.0;
  const auto verdict = [&](double value, DecisionRule rule) {
    c.value = value;
    c.expanded_uncertainty = 0.2;
    c.interval = TrueValueInterval{value - 0.2, value + 0.2};
    return verdict_of(c, rule);
  };
  using enum DecisionRule;
  EXPECT_EQ(verdict(10.9, simple), Verdict::pass);
  EXPECT_EQ(verdict(11.1, simple), Verdict::fail);
  for (const double side : {-1.0, 1.0}) {
    EXPECT_EQ(verdict(10.0 + 0.79 * side, iso14253), Verdict::pass);
    EXPECT_EQ(verdict(10.0 + 0.81 * side, iso14253), Verdict::uncertain);
    EXPECT_EQ(verdict(10.0 + 1.19 * side, iso14253), Verdict::uncertain);
    EXPECT_EQ(verdict(10.0 + 1.21 * side, iso14253), Verdict::fail);
  }
  // The value need not be within its interval, which decides nothing: value +- U does.
  c.value = 11.5;
  c.expanded_uncertainty = 2.0;
  c.interval = TrueValueInterval{.low = 9.5, .high = 10.5};
  EXPECT_EQ(verdict_of(c, iso14253), Verdict::uncertain);
  c.value = 10.5;
  c.expanded_uncertainty = 1.0;
  c.interval = TrueValueInterval{.low = 10.5, .high = 11.5};
  EXPECT_EQ(verdict_of(c, iso14253), Verdict::uncertain);
  Measurement m;
  m.characteristics = {c};
  decide(m, iso14253);
  EXPECT_FALSE(m.characteristics.front().pass);
  EXPECT_EQ(m.verdict(), Verdict::uncertain);
  EXPECT_FALSE(m.passes());
}

}  // namespace
}  // namespace frustum::metrology
