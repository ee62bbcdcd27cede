// The published recipes that take eight machine errors from step patterns one after the other.
//
// Model    : closed forms (10) to (21) of the source, solved for one error a step; Case 1 with
//            patterns 1-a, 2-a, 3, 4, Case 2 with all but 4. Means of several ways are unweighted
//            and no uncertainty comes out: identification.hpp is what to use, this is for
//            comparison
// Units    : mm, rad
// Shape    : one StepMeasurement a pattern
// Errors   : the characteristics that are missing, sizes or values that are not finite
// Accuracy : table 8 as far as its inputs are printed (tests/calibration/step_recipes_test.cpp)
// Source   : Ibaraki, Sawada, Matsubara, Matsushita: machining tests to identify kinematic errors
//            on five-axis machine tools, section 4
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace frustum::calibration {

struct StepMeasurement {
  std::string pattern{};  // "1-a"
  std::optional<double> dL{}, dH{}, theta{}, phi{}, dL0{};
  // Nominal sizes: H above the tilt axis, L, Cy of the workpiece, h and l of its steps.
  double height = 0.0;
  double width = 0.0;
  double centre_y = 0.0;
  double step_height = 5.0;
  double step_width = 5.0;
};

// Squareness of the linear axes, measured beforehand.
struct KnownSquareness {
  double gamma_YX = 0.0;
  double alpha_ZY = 0.0;
  double beta_ZX = 0.0;
};

// Where the equations as printed and a computation from first principles differ.
struct RecipeVariant {
  bool equation_12_corrected = false;  // +2 Cy instead of -2 Cy of beta in dH of 1-b
  bool equation_20_with_2h = false;  // L - 2 Cy - 2 H instead of L - 2 Cy of alpha_AY in dL of 6-b
  bool gamma_yx_in_phi = false;      // gamma_AY - gamma_YX instead of gamma_AY in phi of 3 and 4
};

struct RecipeInput {
  std::string name{};  // "1-a.phi", "alpha_AY"
  double value = 0.0;
  bool angular = false;
};

struct RecipeStep {
  std::string step{};      // "2 (iii)"
  std::string quantity{};  // "beta_AY + beta_CA"
  std::string equation{};  // "(12)"; empty for means and differences
  std::string formula{};
  std::vector<RecipeInput> inputs{};
  double value = 0.0;
  bool angular = false;
};

struct RecipeErrors {
  double alpha_AY = 0.0, beta_AY = 0.0, gamma_AY = 0.0, beta_CA = 0.0;  // rad
  double dx_AY = 0.0, dy_AY = 0.0, dz_AY = 0.0, dy_CA = 0.0;            // mm
};

struct Recipe {
  std::vector<RecipeStep> steps{};
  RecipeErrors errors{};
};

[[nodiscard]] Result<Recipe> recipe_case_1(std::span<const StepMeasurement> measured,
                                           const KnownSquareness& known,
                                           const RecipeVariant& variant = {});
[[nodiscard]] Result<Recipe> recipe_case_2(std::span<const StepMeasurement> measured,
                                           const KnownSquareness& known,
                                           const RecipeVariant& variant = {});

}  // namespace frustum::calibration
