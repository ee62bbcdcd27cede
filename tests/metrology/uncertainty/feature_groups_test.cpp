// What many features cost: those that nothing rests on together are moved at once.
#include "metrology/uncertainty/feature_groups.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "metrology/cmm.hpp"
#include "metrology/evaluation.hpp"
#include "tests/metrology/measured_feature.hpp"

namespace frustum::metrology {
namespace {

using K = CharacteristicKind;

// A plate with holes, each with a diameter, a position and a roundness.
InspectionPlan plate_with(std::size_t holes) {
  InspectionPlan plan;
  plan.features = {
      measured::plane("top", {0, 0, 0}, Vec3::UnitZ(), 100 * Vec3::UnitX(), 100 * Vec3::UnitY())};
  plan.datum = DatumSystem{"top"};
  for (std::size_t i = 0; i < holes; ++i) {
    const auto k = static_cast<double>(i);
    plan.features.push_back(measured::cylinder(fmt::format("hole {}", i), {12.0 * k, 0.0, -5.0},
                                               Vec3::UnitZ(), 4.0, {-2.0, 2.0}, 8));
    plan.features.back().side = Side::inside;
    for (const K kind : {K::diameter, K::position, K::roundness}) {
      PlannedCharacteristic c = measured::characteristic(kind, {plan.features.back().name});
      c.name = fmt::format("{} {}", name_of(kind), i);
      plan.characteristics.push_back(std::move(c));
    }
  }
  return plan;
}

std::vector<FittedFeature> measured_plate(const InspectionPlan& plan) {
  std::vector<FittedFeature> features;
  for (const PlannedFeature& f : plan.features) {
    features.push_back(measured::feature(f, Pose::translated({0.02, 0.01, 0.0}), [](const Vec3& p) {
      return 0.003 * std::sin(1.3 * p.x() + 0.7 * p.y() + 0.4 * p.z());
    }));
  }
  return features;
}

TEST(FeatureGroups, Fault2_59_HolesThatNothingHasInCommonAreOneGroup) {
  const InspectionPlan plan = plate_with(200);
  const std::vector<FittedFeature> features = measured_plate(plan);
  const FeatureGroups rest = feature_groups(plan, features);
  ASSERT_EQ(rest.groups.size(), 2U);  // the datum, and all holes
  EXPECT_EQ(rest.groups[0], (std::vector<std::size_t>{0}));
  EXPECT_EQ(rest.groups[1].size(), 200U);
  EXPECT_EQ(rest.of(3 * 17, 0), 0U);   // in the datum system all rest on the top
  EXPECT_EQ(rest.of(3 * 17, 1), 18U);  // and on their own hole
}

TEST(FeatureGroups, Fault2_59_FeaturesOfOneCharacteristicAreApart) {
  InspectionPlan plan = plate_with(4);
  plan.datum.reset();
  plan.characteristics.push_back(measured::characteristic(K::parallelism, {"hole 0", "hole 1"}));
  plan.characteristics.back().name = "parallel";
  plan.characteristics.push_back(measured::characteristic(K::parallelism, {"hole 1", "hole 2"}));
  plan.characteristics.back().name = "parallel 2";
  const FeatureGroups rest = feature_groups(plan, measured_plate(plan));
  // Nothing rests on the top.
  EXPECT_EQ(rest.groups, (std::vector<std::vector<std::size_t>>{{1, 3, 4}, {2}}));
}

// Minutes each before: the whole plate was fitted again for every change of every hole.
TEST(LinearUncertainty, Fault2_59_OfOneHoleAmongManyIsThatOfItAlone) {
  const CmmModel cmm{.e0_mm = 0.002, .length_per_error = 300.0};
  const InspectionPlan many = plate_with(2000);
  const std::vector<FittedFeature> features = measured_plate(many);
  const auto of_many = evaluated(many, features, cmm);
  ASSERT_TRUE(of_many) << to_string(of_many.error().front());
  const InspectionPlan one = plate_with(1);
  const auto of_one = evaluated(one, measured_plate(one), cmm);
  ASSERT_TRUE(of_one);
  for (std::size_t c = 0; c < of_one->characteristics.size(); ++c) {
    const CharacteristicResult& alone = of_one->characteristics[c];
    EXPECT_NEAR(of_many->characteristics[c].expanded_uncertainty, alone.expanded_uncertainty,
                1e-6 * alone.expanded_uncertainty)
        << alone.name;
    EXPECT_GT(alone.expanded_uncertainty, 0.0);
  }
}

}  // namespace
}  // namespace frustum::metrology
