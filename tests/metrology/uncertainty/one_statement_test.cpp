// One statement of a value: U goes to the far end of the interval, and the verdict is that of value
// +- U, as every receiver of a result can find it again.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "metrology/decision_rule.hpp"
#include "tests/metrology/test_part.hpp"

namespace frustum::metrology {
namespace {

const CmmModel kStatedCmm{.e0_mm = 0.002, .length_per_error = 300.0, .seed = 7};

Measurement measured_lobed(const InspectionPlan& plan, const CmmModel& cmm) {
  auto m = measure(plan, test_part::part({.lobe = 0.001}), cmm);
  EXPECT_TRUE(m) << (m ? "" : to_string(m.error().front()));
  return m ? *m : Measurement{};
}

std::vector<FeaturePoints> probed_points(const Measurement& measurement) {
  std::vector<FeaturePoints> points;
  for (const MeasuredFeature& f : measurement.features) {
    FeaturePoints p{f.name, {}, {}};
    for (const MeasuredPoint& m : f.points) p.points.push_back(m.point);
    points.push_back(std::move(p));
  }
  return points;
}

bool is_remarked(const Measurement& measurement, DiagnosticId id) {
  return std::any_of(measurement.diagnostics.begin(), measurement.diagnostics.end(),
                     [&](const Diagnostic& d) { return d.id == id; });
}

TEST(OneStatement, Fault2_36_TheVerdictOfASizeIsThatOfValueAndU) {
  // A flatness: its interval is longer below the value than above it.
  CharacteristicResult c;
  c.value = 13.53;
  c.expanded_uncertainty = 4.91;
  c.interval = TrueValueInterval{8.62, 16.31, Coverage::at_least_95};
  const auto verdict = [&](double tolerance) {
    c.tolerance = tolerance;
    return verdict_of(c, DecisionRule::iso14253);
  };
  EXPECT_EQ(verdict(8.61), Verdict::fail);  // 13.53 - 4.91 = 8.62
  EXPECT_EQ(verdict(8.63), Verdict::uncertain);
  EXPECT_EQ(verdict(17.0), Verdict::uncertain);  // 13.53 + 4.91 = 18.44
  EXPECT_EQ(verdict(18.43), Verdict::uncertain);
  EXPECT_EQ(verdict(18.44), Verdict::pass);
  // Value - U below 0 is no fault of a size.
  c.value = 0.5;
  c.expanded_uncertainty = 1.0;
  c.interval = TrueValueInterval{0.0, 1.5, Coverage::at_least_95};
  EXPECT_EQ(verdict(1.5), Verdict::pass);
  EXPECT_EQ(verdict(0.7), Verdict::uncertain);
}

TEST(OneStatement, Fault2_36_UEndsWhereTheIntervalIsCutAtZero) {
  InspectionPlan plan = test_part::plan();
  std::size_t cut = 0;
  for (const bool is_simulated : {false, true}) {
    if (is_simulated) plan.monte_carlo = MonteCarloSettings{.draws = 2000};
    for (const CharacteristicResult& c : measured_lobed(plan, kStatedCmm).characteristics) {
      ASSERT_TRUE(c.interval) << c.name;
      const double far = std::max(c.value - c.interval->low, c.interval->high - c.value);
      EXPECT_NEAR(c.expanded_uncertainty, far, 1e-12 * std::max(1.0, std::abs(c.value))) << c.name;
      cut += !c.nominal && c.interval->low == 0.0 && c.value > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(cut, 2U);  // forms that are not separate from the noise
}

TEST(OneStatement, Fault2_36_AnIntervalCorrectedForABiasSaysSoAndDecidesNothing) {
  // 10 K too warm: 50 mm are seen as 50 mm (1 + 10 11.5e-6) = 50.00575 mm.
  CmmModel warm{.e0_mm = 0.001, .seed = 3};
  warm.temperature = ThermalState{.part = 30.0};
  InspectionPlan plan = test_part::plan();
  plan.decision = DecisionRule::iso14253;
  for (PlannedCharacteristic& c : plan.characteristics) {
    if (c.name == "cylinder.diameter") c.tolerance = 0.0075;
  }
  const auto judged = [&] {
    const Measurement m = measured_lobed(plan, warm);
    EXPECT_EQ(is_remarked(m, "interval-corrected"_id), plan.monte_carlo.has_value());
    return m.characteristics[*m.find("cylinder.diameter")];
  };
  EXPECT_EQ(judged().verdict(), Verdict::uncertain);
  plan.monte_carlo = MonteCarloSettings{.draws = 2000};
  const CharacteristicResult c = judged();
  EXPECT_NEAR(c.value, 50.00575, 0.001);
  EXPECT_FALSE(c.is_value_in_interval());
  EXPECT_LT(c.interval->high, 50.002);
  EXPECT_EQ(c.expanded_uncertainty, c.value - c.interval->low);
  EXPECT_EQ(c.verdict(), Verdict::uncertain);  // 50.00575 + 0.006 > 50.0075
}

TEST(OneStatement, Fault2_36_NothingIsDecidedOfAMachineOfWhichNothingIsKnown) {
  InspectionPlan plan = test_part::plan();
  const auto points = probed_points(measured_lobed(plan, {}));
  plan.decision = DecisionRule::iso14253;
  const auto unknown = evaluate(plan, points);
  ASSERT_TRUE(unknown) << to_string(unknown.error().front());
  EXPECT_TRUE(is_remarked(*unknown, "decision-without-accuracy"_id));
  for (const CharacteristicResult& c : unknown->characteristics) {
    EXPECT_EQ(c.verdict(), Verdict::uncertain) << c.name;
    EXPECT_EQ(c.coverage(), Coverage::not_stated) << c.name;
  }
  // A virtual machine without errors is ideal; without the rule the value alone decides.
  for (const CharacteristicResult& c : measured_lobed(plan, {}).characteristics) {
    EXPECT_EQ(c.verdict(), verdict_of(c, DecisionRule::simple)) << c.name;
    EXPECT_FALSE(c.coverage()) << c.name;
  }
  plan.decision = DecisionRule::simple;
  const auto simple = evaluate(plan, points);
  ASSERT_TRUE(simple);
  for (const CharacteristicResult& c : simple->characteristics) {
    EXPECT_NE(c.verdict(), Verdict::uncertain) << c.name;
  }
  EXPECT_FALSE(is_remarked(*simple, "decision-without-accuracy"_id));
}

}  // namespace
}  // namespace frustum::metrology
