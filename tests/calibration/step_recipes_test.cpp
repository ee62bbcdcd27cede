#include "calibration/design/step_recipes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/units.hpp"
#include "tests/calibration/step_patterns.hpp"
#include "tests/document_section.hpp"

namespace frustum::calibration {
namespace {

// Table 8's units: deg, mm.
std::map<std::string, double> table_8(const RecipeErrors& e) {
  return {{"a_AY", e.alpha_AY * kDegPerRad},
          {"b_AY", e.beta_AY * kDegPerRad},
          {"g_AY", e.gamma_AY * kDegPerRad},
          {"b_CA", e.beta_CA * kDegPerRad},
          {"dx_AY", e.dx_AY},
          {"dy_AY", e.dy_AY},
          {"dz_AY", e.dz_AY},
          {"dy_CA", e.dy_CA}};
}

void expect_column(const char* column, const char* sizes, bool flip,
                   const RecipeVariant& variant = {}) {
  const auto recipe = recipe_case_2(published_steps(sizes, flip), published_squareness(), variant);
  ASSERT_TRUE(recipe) << recipe.error().front().message;
  const auto values = table_8(recipe->errors);
  for (const auto& [name, expected] : step_data()["table8"][column].items()) {
    EXPECT_NEAR(values.at(name), expected.get<double>(), 1e-6) << column << " " << name;
  }
}

TEST(StepRecipesReference, ReproducesTable8AsFarAsItsInputsArePrinted) {
  expect_column("A_as_printed", "printed", false);
  expect_column("B_dH1b_minus", "printed", true);
  expect_column("C_consistent", "consistent", true);
  expect_column("D_first_principles", "consistent", true, {false, true, true});
}

// The printed digits of four errors, and those that no reading gives.
TEST(StepRecipesReference, AgreesWithThePublishedDigitsOfFourErrors) {
  const auto recipe = recipe_case_2(published_steps("printed", true), published_squareness());
  ASSERT_TRUE(recipe);
  const auto values = table_8(recipe->errors);
  const nlohmann::json& published = step_data()["table8"]["published"];
  for (const char* name : {"a_AY", "b_AY"}) {
    EXPECT_NEAR(values.at(name), published[name].get<double>(), 0.5e-4) << name;
  }
  for (const char* name : {"dx_AY", "dz_AY"}) {
    EXPECT_NEAR(values.at(name), published[name].get<double>(), 0.5e-3) << name;
  }
  EXPECT_NEAR(values.at("dy_AY") + values.at("dy_CA"), 0.018, 0.5e-3);
}

// What can be said of the published digits, by error.
constexpr std::pair<const char*, const char*> kTable8Verdicts[] = {
    {"a_AY", "reproduced"},
    {"b_AY", "reproduced"},
    {"g_AY", "within 0.0001 deg by B and C, not to the last digit"},
    {"b_CA", "not reproduced; 0.0010 would fit, probably a misprint"},
    {"dx_AY", "reproduced with dH of 1-b = -9.9 um (text of section 5), not +9.9 (Table 5)"},
    {"dy_AY", "not reproduced; dy_AY + dy_CA = 0.018 is"},
    {"dz_AY", "reproduced"},
    {"dy_CA", "not reproduced: the two ways give -0.0133 and -0.0076"}};

TEST(StepRecipesReference, WritesTable8) {
  const struct {
    const char* sizes;
    bool flip;
    RecipeVariant variant;
  } readings[] = {{"printed", false, {}},
                  {"printed", true, {}},
                  {"consistent", true, {}},
                  {"consistent", true, {false, true, true}}};
  std::vector<std::map<std::string, double>> columns;
  for (const auto& r : readings) {
    const auto recipe =
        recipe_case_2(published_steps(r.sizes, r.flip), published_squareness(), r.variant);
    ASSERT_TRUE(recipe);
    columns.push_back(table_8(recipe->errors));
  }
  std::string page =
      "## Step patterns, identified errors (Table 8, Case 2)\n\n"
      "By the paper's recipe from its Tables 5 to 7. A: equations and sizes as printed. B: dH of "
      "1-b with "
      "the sign of the\ntext. C: B with sizes that can be machined together. D: C with 2H in "
      "equation (20) "
      "and gamma_YX in phi of pattern\n3. Angles in deg, lengths in mm.\n\n"
      "| error | published | A | B | C | D | verdict |\n| --- | --- | --- | --- | --- | --- | --- "
      "|\n";
  for (const auto& [name, verdict] : kTable8Verdicts) {
    page += fmt::format("| {} | {:+.4g} |", name,
                        step_data()["table8"]["published"][name].get<double>());
    for (const auto& column : columns) page += fmt::format(" {:+.5f} |", column.at(name));
    page += fmt::format(" {} |\n", verdict);
  }
  expect_section("reproduction.md", "identified errors", page);
}

// Measurements that the closed forms predict for these errors.
std::vector<StepMeasurement> predicted(const std::map<std::string, double>& errors,
                                       const std::vector<std::string>& patterns) {
  std::vector<StepMeasurement> steps;
  for (const std::string& pattern : patterns) {
    const nlohmann::json& size = step_data()["patterns"][pattern]["nominal"]["consistent"];
    const nlohmann::json gains = closed_form(pattern, size);
    const auto value = [&](const char* quantity) -> std::optional<double> {
      if (!gains.contains(quantity)) return std::nullopt;
      double sum = 0.0;  // um or urad, as the errors
      for (const auto& [error, gain] : gains[quantity].items()) {
        sum += gain.get<double>() * errors.at(error);
      }
      return sum * (quantity[0] == 'd' ? 1e-3 : 1e-6);
    };
    StepMeasurement step{pattern, value("dL"), value("dH"), value("th"), value("ph"), value("dL0")};
    step.height = size["H"].get<double>();
    step.width = size["L"].get<double>();
    step.centre_y = size["Cy"].get<double>();
    steps.push_back(step);
  }
  return steps;
}

const std::map<std::string, double> kTrue{{"a_AY", 11.0}, {"b_AY", -37.0}, {"b_CA", 23.0},
                                          {"g_AY", 41.0}, {"dx_AY", 7.0},  {"dy_AY", -13.0},
                                          {"dy_CA", 5.0}, {"dz_AY", 29.0}, {"g_YX", 0.0},
                                          {"a_ZY", 17.0}, {"b_ZX", -19.0}, {"d_r", 12.0}};
const KnownSquareness kKnown{0.0, 17e-6, -19e-6};

void expect_true(const RecipeErrors& e) {
  EXPECT_NEAR(e.alpha_AY, 11e-6, 1e-15);
  EXPECT_NEAR(e.beta_AY, -37e-6, 1e-15);
  EXPECT_NEAR(e.beta_CA, 23e-6, 1e-15);
  EXPECT_NEAR(e.gamma_AY, 41e-6, 1e-15);
  EXPECT_NEAR(e.dx_AY, 7e-3, 1e-12);
  EXPECT_NEAR(e.dy_AY, -13e-3, 1e-12);
  EXPECT_NEAR(e.dy_CA, 5e-3, 1e-12);
  EXPECT_NEAR(e.dz_AY, 29e-3, 1e-12);
}

TEST(StepRecipes, RecoverTheErrorsThatTheClosedFormsWereGiven) {
  const auto first = recipe_case_1(predicted(kTrue, {"1-a", "2-a", "3", "4"}), kKnown);
  ASSERT_TRUE(first) << first.error().front().message;
  expect_true(first->errors);
  const auto second = recipe_case_2(predicted(kTrue, all_patterns()), kKnown);
  ASSERT_TRUE(second) << second.error().front().message;
  expect_true(second->errors);
}

TEST(StepRecipes, ListEveryStepWithItsEquationAndInputs) {
  const auto recipe = recipe_case_2(predicted(kTrue, all_patterns()), kKnown);
  ASSERT_TRUE(recipe);
  ASSERT_FALSE(recipe->steps.empty());
  for (const RecipeStep& step : recipe->steps) {
    EXPECT_FALSE(step.inputs.empty()) << step.step;
    EXPECT_FALSE(step.formula.empty()) << step.step;
  }
  const RecipeStep& alpha = recipe->steps.front();
  EXPECT_EQ(alpha.step, "1");
  EXPECT_EQ(alpha.quantity, "alpha_AY");
  EXPECT_EQ(alpha.equation, "(14)");
  EXPECT_EQ(alpha.inputs.front().name, "2-b.phi");
  EXPECT_NEAR(alpha.inputs.front().value, 22e-6, 1e-15);
  EXPECT_TRUE(alpha.angular);
}

TEST(StepRecipes, NameWhatIsMissing) {
  const auto recipe = recipe_case_1(predicted(kTrue, {"1-a", "2-a", "3"}), kKnown);
  ASSERT_FALSE(recipe);
  EXPECT_EQ(recipe.error().front().message, "Case 1 needs 4.dL, 4.theta, 4.phi");
  auto central = predicted(kTrue, {"1-a", "2-a", "3", "4"});
  central[3].centre_y = 0.0;
  EXPECT_FALSE(recipe_case_1(central, kKnown));
  auto infinite = predicted(kTrue, {"1-a", "2-a", "3", "4"});
  infinite[0].dL = std::nan("");
  EXPECT_FALSE(recipe_case_1(infinite, kKnown));
  auto vast = predicted(kTrue, {"1-a", "2-a", "3", "4"});
  vast[3].dL = 1.5e308;
  vast[3].theta = 1e308;
  EXPECT_FALSE(recipe_case_1(vast, kKnown));
}

}  // namespace
}  // namespace frustum::calibration
