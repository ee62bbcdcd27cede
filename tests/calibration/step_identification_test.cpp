// The joint fit of the published measurements and the identifiability of pattern sets, against an
// independent computation.
#include <gtest/gtest.h>

#include <cmath>

#include "calibration/identify/identification.hpp"
#include "calibration/identify/information.hpp"
#include "core/units.hpp"
#include "tests/calibration/step_patterns.hpp"

namespace frustum::calibration {
namespace {

struct Fit {
  const char* name;
  Gains gains;
  bool flip;
  Floor floor;
};

// What the reference's rounding of sensitivities to 1e-7 leaves: 1e-4 urad, 1e-5 um.
void expect_fit(const Fit& fit) {
  const auto result = identify(published(fit.gains, fit.flip), {fit.floor, 0.95, {}});
  ASSERT_TRUE(result) << result.error().front().message;
  const nlohmann::json& expected = step_data()["joint_wls"][fit.name];
  for (const Estimate& estimate : result->estimates) {
    const double unit = estimate.angular ? kUradPerRad : kUmPerMm;
    ASSERT_TRUE(estimate.value) << fit.name << " " << estimate.name;
    EXPECT_NEAR(*estimate.value * unit, expected["x"][estimate.name].get<double>(), 1e-4)
        << fit.name << " " << estimate.name;
    EXPECT_NEAR(*estimate.standard_uncertainty * unit, expected["sd"][estimate.name].get<double>(),
                2e-6)
        << fit.name << " " << estimate.name;
  }
  EXPECT_NEAR(result->agreement.chi_square, expected["chi2"].get<double>(), 2e-3) << fit.name;
  EXPECT_EQ(result->agreement.degrees_of_freedom, expected["dof"].get<int>()) << fit.name;
  EXPECT_NEAR(*result->agreement.birge, expected["scale"].get<double>(), 1e-5) << fit.name;
  EXPECT_NEAR(*result->observability.condition_weighted, expected["cond_weighted"].get<double>(),
              1e-5)
      << fit.name;
  EXPECT_NEAR(*result->observability.condition_columns, expected["cond_colscaled"].get<double>(),
              1e-6)
      << fit.name;
}

TEST(StepIdentificationReference, FindsTheJointFitOfTables5To7) {
  expect_fit({"fp_eq4", Gains::eq4, false, {}});
  expect_fit({"fp_trans", Gains::trans, false, {}});
  expect_fit({"fp_eq4_dH1b_flipped", Gains::eq4, true, {}});
  expect_fit({"fp_eq4_floor", Gains::eq4, false, {4e-3, 20e-6}});
}

TEST(StepIdentificationReference, FindsTheJointFitWithTheClosedFormsAsPrinted) {
  expect_fit({"closed_printed", Gains::closed_printed, false, {}});
  expect_fit({"closed_printed_dH1b_flipped", Gains::closed_printed, true, {}});
}

TEST(StepIdentificationReference, UsesTheClosedFormsOfTheFile) {
  for (const std::string& pattern : all_patterns()) {
    const nlohmann::json& entry = step_data()["patterns"][pattern];
    const nlohmann::json mine = closed_form(pattern, entry["nominal"]["consistent"]);
    for (const auto& [quantity, gains] : entry["closed_form"].items()) {
      for (const auto& [error, gain] : gains.items()) {
        EXPECT_NEAR(mine[quantity].value(error, 0.0), gain.get<double>(), 1e-6)
            << pattern << " " << quantity << " " << error;
      }
    }
  }
}

TEST(StepIdentificationReference, RejectsTheRigidModelForThePublishedParts) {
  const auto result = identify(published(Gains::eq4));
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->agreement.rejected);
  EXPECT_LT(*result->agreement.probability, 1e-300);
  ASSERT_TRUE(result->suspect);
  std::string all;
  for (const Diagnostic& d : result->diagnostics) all += d.message + "\n";
  EXPECT_NE(all.find("the model does not explain the measurements: chi2 = 3877 with 27"),
            std::string::npos)
      << all;
  EXPECT_NE(all.find("the Birge factor, by which they would have to grow, is 12"),
            std::string::npos)
      << all;
  const auto with_floor = identify(published(Gains::eq4), {{4e-3, 20e-6}, 0.95, {}});
  EXPECT_FALSE(with_floor->agreement.rejected);
}

void expect_identifiable(const char* name, std::vector<std::string> patterns) {
  const auto result = identify(planned(patterns));
  ASSERT_TRUE(result) << result.error().front().message;
  const nlohmann::json& expected = step_data()["identifiability"][name];
  EXPECT_EQ(result->observability.rank, expected["rank"].get<int>()) << name;
  EXPECT_EQ(result->observability.unknowns, expected["n"].get<int>()) << name;
  if (expected["cond"].is_null()) {
    EXPECT_FALSE(result->observability.condition_weighted) << name;
    return;
  }
  EXPECT_NEAR(*result->observability.condition_weighted, expected["cond"].get<double>(), 1e-4);
  EXPECT_NEAR(*result->observability.condition_columns, expected["cond_col"].get<double>(), 1e-5);
  for (const Estimate& estimate : result->estimates) {
    if (estimate.fixed) continue;
    const double unit = estimate.angular ? kUradPerRad : kUmPerMm;
    EXPECT_NEAR(*estimate.standard_uncertainty * unit, expected["sd"][estimate.name].get<double>(),
                1e-6)
        << name << " " << estimate.name;
  }
}

TEST(StepIdentificationReference, KnowsWhichPatternsIdentifyEverything) {
  expect_identifiable("Case 1 {1-a,2-a,3,4}", {"1-a", "2-a", "3", "4"});
  expect_identifiable("Case 2 (all but 4)",
                      {"1-a", "1-b", "2-a", "2-b", "3", "5-a", "5-b", "6-a", "6-b", "7"});
  expect_identifiable("all", all_patterns());
  expect_identifiable("{1-a,2-a,3}", {"1-a", "2-a", "3"});
}

TEST(StepIdentification, SaysWhatHangsOnOnePattern) {
  const std::vector<std::string> patterns{"1-a", "2-a", "3", "4"};
  const auto shares = information_shares(planned(patterns));
  ASSERT_TRUE(shares);
  ASSERT_EQ(shares->groups, (std::vector<std::string>{"1-a", "2-a", "3", "4"}));
  // dx_AY (4) comes from 2-a alone, beta_AY (1) needs 4; d_r (11) is in every pattern.
  EXPECT_EQ(shares->shares(4, 1), 1.0);
  EXPECT_LT(shares->shares(4, 2), 0.5);
  EXPECT_EQ(shares->shares(1, 3), 1.0);
  EXPECT_LT(shares->shares.row(11).maxCoeff(), 0.5);
  EXPECT_EQ(shares->shares.row(8).maxCoeff(), 0.0);
}

}  // namespace
}  // namespace frustum::calibration
