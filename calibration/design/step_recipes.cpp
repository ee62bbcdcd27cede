#include "calibration/design/step_recipes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace frustum::calibration {
namespace {

constexpr double kRoot2 = std::numbers::sqrt2;

struct Needed {
  const char* pattern;
  const char* quantity;
};
constexpr std::array kCase1{Needed{"1-a", "dL"},  Needed{"1-a", "dL0"}, Needed{"2-a", "dL"},
                            Needed{"2-a", "phi"}, Needed{"2-a", "dL0"}, Needed{"3", "dL"},
                            Needed{"3", "phi"},   Needed{"4", "dL"},    Needed{"4", "theta"},
                            Needed{"4", "phi"}};
constexpr std::array kCase2{
    Needed{"1-a", "dL"},    Needed{"1-a", "phi"}, Needed{"1-a", "dL0"},   Needed{"1-b", "dL"},
    Needed{"1-b", "dH"},    Needed{"1-b", "dL0"}, Needed{"2-a", "dL"},    Needed{"2-a", "dL0"},
    Needed{"2-b", "dL"},    Needed{"2-b", "dH"},  Needed{"2-b", "phi"},   Needed{"2-b", "dL0"},
    Needed{"3", "dL"},      Needed{"3", "phi"},   Needed{"5-a", "theta"}, Needed{"6-a", "dL"},
    Needed{"6-a", "theta"}, Needed{"6-b", "dL"},  Needed{"7", "theta"}};

const StepMeasurement* find(std::span<const StepMeasurement> measured, std::string_view pattern) {
  const auto hit = std::find_if(measured.begin(), measured.end(),
                                [&](const StepMeasurement& m) { return m.pattern == pattern; });
  return hit == measured.end() ? nullptr : &*hit;
}

std::optional<double> quantity_of(const StepMeasurement& m, std::string_view quantity) {
  if (quantity == "dL") return m.dL;
  if (quantity == "dH") return m.dH;
  if (quantity == "theta") return m.theta;
  if (quantity == "phi") return m.phi;
  assert(quantity == "dL0");
  return m.dL0;
}

Diagnostics wrong_inputs(std::span<const StepMeasurement> measured, std::span<const Needed> needed,
                         const KnownSquareness& known, const char* title) {
  std::string missing;
  for (const Needed& need : needed) {
    const StepMeasurement* m = find(measured, need.pattern);
    if (m == nullptr || !quantity_of(*m, need.quantity)) {
      missing += fmt::format("{}{}.{}", missing.empty() ? "" : ", ", need.pattern, need.quantity);
    }
  }
  Diagnostics found;
  if (!missing.empty()) {
    found.push_back(error("step-value-missing"_id, fmt::format("{} needs {}", title, missing),
                          "the weighted identification takes whatever was measured"));
  }
  for (const StepMeasurement& m : measured) {
    double sum = m.height + m.width + m.centre_y + m.step_height + m.step_width;
    for (const char* quantity : {"dL", "dH", "theta", "phi", "dL0"}) {
      sum += quantity_of(m, quantity).value_or(0.0);
    }
    if (!std::isfinite(sum)) {
      found.push_back(error("not-a-number"_id,
                            "a size or value of pattern " + m.pattern + " is not a finite number"));
    } else if (m.centre_y == 0.0 || m.width + m.step_width + 2.0 * m.centre_y == 0.0) {
      // Height differences divide by both.
      found.push_back(error("pattern-on-axis"_id,
                            "pattern " + m.pattern + " is on the turn axis: Cy is too near to 0",
                            "give Cy of the workpiece centre"));
    }
  }
  if (!std::isfinite(known.gamma_YX + known.alpha_ZY + known.beta_ZX)) {
    found.push_back(error("not-a-number"_id, "a known squareness is not a finite number"));
  }
  return found;
}

// The steps, each with the inputs its formula names.
class Steps {
 public:
  Steps(std::span<const StepMeasurement> measured, const RecipeVariant& variant)
      : measured_(measured), variant_(variant) {}

  [[nodiscard]] const StepMeasurement& of(const char* pattern) const {
    return *find(measured_, pattern);
  }
  [[nodiscard]] RecipeInput input(const char* pattern, const char* quantity) const {
    const bool angular = quantity[0] == 't' || quantity[0] == 'p';
    return {fmt::format("{}.{}", pattern, quantity), *quantity_of(of(pattern), quantity), angular};
  }
  [[nodiscard]] const RecipeVariant& variant() const { return variant_; }

  double add(RecipeStep step) {
    steps_.push_back(std::move(step));
    return steps_.back().value;
  }
  double mean(const char* step, const char* quantity, std::vector<RecipeInput> inputs) {
    double sum = 0.0;
    for (const RecipeInput& one : inputs) sum += one.value;
    const bool angular = inputs.front().angular;
    const double value = sum / static_cast<double>(inputs.size());
    return add({step, quantity, "", "mean", std::move(inputs), value, angular});
  }

  double radius(const char* pattern) {
    return add({"tool",
                fmt::format("d_r of {}", pattern),
                "(11)",
                "-dL0/2",
                {input(pattern, "dL0")},
                -0.5 * *of(pattern).dL0,
                false});
  }
  double alpha(const char* pattern, const char* equation) {
    return add({"1",
                "alpha_AY",
                equation,
                "phi/2",
                {input(pattern, "phi")},
                0.5 * *of(pattern).phi,
                true});
  }
  // Sum of dy_AY and dy_CA from dL of 1-a or 1-b.
  double dy_sum(const char* step, const char* pattern, const char* equation, double alpha_AY,
                double alpha_ZY) {
    const StepMeasurement& m = of(pattern);
    const double d_r = radius(pattern);
    const double arm = m.height + 0.5 * m.step_height;
    return add({step,
                "dy_AY + dy_CA",
                equation,
                "dL/2 + (H + h/2) (alpha_AY - alpha_ZY) + d_r",
                {input(pattern, "dL"),
                 {"alpha_AY", alpha_AY, true},
                 {"alpha_ZY", alpha_ZY, true},
                 {"d_r", d_r, false}},
                0.5 * *m.dL + arm * (alpha_AY - alpha_ZY) + d_r,
                false});
  }
  // From dL of 2-a or 2-b; `beta` is beta_AY + beta_CA.
  double dx(const char* step, const char* pattern, const char* equation, double beta,
            double beta_ZX) {
    const StepMeasurement& m = of(pattern);
    const double d_r = radius(pattern);
    const double arm = m.height + 0.5 * m.step_height;
    return add({step,
                "dx_AY",
                equation,
                "-dL/2 - (H + h/2) (beta_AY + beta_CA - beta_ZX) - d_r",
                {input(pattern, "dL"),
                 {"beta_AY + beta_CA", beta, true},
                 {"beta_ZX", beta_ZX, true},
                 {"d_r", d_r, false}},
                -0.5 * *m.dL - arm * (beta - beta_ZX) - d_r,
                false});
  }
  double dy_ca_of_3(const char* step, double alpha_AY, double dz_AY) {
    const StepMeasurement& m = of("3");
    return add({step,
                "dy_CA",
                "(15)",
                "(H + h/2) alpha_AY - dz_AY - dL/2",
                {input("3", "dL"), {"alpha_AY", alpha_AY, true}, {"dz_AY", dz_AY, false}},
                (m.height + 0.5 * m.step_height) * alpha_AY - dz_AY - 0.5 * *m.dL,
                false});
  }
  // phi of 3 holds beta_CA + gamma_AY; `known` is one of them, the other comes out.
  double of_phi_3(const char* step, const char* quantity, const RecipeInput& known,
                  double gamma_YX) {
    RecipeStep s{step,
                 quantity,
                 "(15)",
                 "phi/2 - " + known.name,
                 {input("3", "phi"), known},
                 0.5 * *of("3").phi - known.value,
                 true};
    add_gamma(s, gamma_YX);
    return add(std::move(s));
  }
  // With the variant phi holds gamma_AY - gamma_YX.
  void add_gamma(RecipeStep& step, double gamma_YX) const {
    if (!variant_.gamma_yx_in_phi) return;
    step.formula += " + gamma_YX";
    step.inputs.push_back({"gamma_YX", gamma_YX, true});
    step.value += gamma_YX;
  }

  [[nodiscard]] Result<Recipe> finish(const RecipeErrors& errors) && {
    for (const RecipeStep& step : steps_) {
      if (std::isfinite(step.value)) continue;
      return error("not-a-number"_id,
                   fmt::format("{} of step {} is not a finite number", step.quantity, step.step),
                   "check the units of the measured values and sizes");
    }
    return Recipe{std::move(steps_), errors};
  }

 private:
  std::span<const StepMeasurement> measured_;
  RecipeVariant variant_;
  std::vector<RecipeStep> steps_{};
};

// beta_AY + beta_CA from dH of 1-b.
double beta_sum_of_1b(Steps& steps, double alpha_AY) {
  const StepMeasurement& m = steps.of("1-b");
  const bool corrected = steps.variant().equation_12_corrected;
  const double rest = *m.dH - (m.width + m.step_width) * alpha_AY;
  const double value = rest / ((corrected ? 2.0 : -2.0) * m.centre_y);
  return steps.add(
      {"2 (iii)",
       "beta_AY + beta_CA",
       "(12)",
       corrected ? "(dH - (L + l) alpha_AY) / (2 Cy)" : "-(dH - (L + l) alpha_AY) / (2 Cy)",
       {steps.input("1-b", "dH"), {"alpha_AY", alpha_AY, true}},
       value,
       true});
}

double beta_sum(Steps& steps, double alpha_AY) {
  const double i = steps.add({"2 (i)",
                              "beta_AY + beta_CA",
                              "(10)",
                              "-phi/2",
                              {steps.input("1-a", "phi")},
                              -0.5 * *steps.of("1-a").phi,
                              true});
  const double iii = beta_sum_of_1b(steps, alpha_AY);
  const StepMeasurement& m = steps.of("2-b");
  const double iv = steps.add({"2 (iv)",
                               "beta_AY + beta_CA",
                               "(14)",
                               "dH / (L + l + 2 Cy)",
                               {steps.input("2-b", "dH")},
                               *m.dH / (m.width + m.step_width + 2.0 * m.centre_y),
                               true});
  return steps.mean("2", "beta_AY + beta_CA",
                    {{"(i)", i, true}, {"(iii)", iii, true}, {"(iv)", iv, true}});
}

double beta_ay(Steps& steps, double beta_ZX) {
  const double i = steps.add({"5 (i)",
                              "beta_AY",
                              "(19)",
                              "theta / (2 (sqrt(2) - 1))",
                              {steps.input("6-a", "theta")},
                              *steps.of("6-a").theta / (2.0 * (kRoot2 - 1.0)),
                              true});
  const double ii = steps.add({"5 (ii)",
                               "beta_AY",
                               "(17)",
                               "-theta/2",
                               {steps.input("5-a", "theta")},
                               -0.5 * *steps.of("5-a").theta,
                               true});
  const double iii = steps.add({"5 (iii)",
                                "beta_AY",
                                "(21)",
                                "beta_ZX - theta / sqrt(2)",
                                {steps.input("7", "theta"), {"beta_ZX", beta_ZX, true}},
                                beta_ZX - *steps.of("7").theta / kRoot2,
                                true});
  return steps.mean("5", "beta_AY", {{"(i)", i, true}, {"(ii)", ii, true}, {"(iii)", iii, true}});
}

double dy_ca(Steps& steps, double alpha_AY, double dz_AY) {
  const double i = steps.dy_ca_of_3("8 (i)", alpha_AY, dz_AY);
  const StepMeasurement& m = steps.of("6-b");
  const bool with_2h = steps.variant().equation_20_with_2h;
  const double arm = m.width - 2.0 * m.centre_y - (with_2h ? 2.0 * m.height : 0.0);
  const double ii =
      steps.add({"8 (ii)",
                 "dy_CA",
                 "(20)",
                 with_2h ? "-dL/2 - (sqrt(2) - 1) dz_AY - (L/2 - Cy - H) alpha_AY"
                         : "-dL/2 - (sqrt(2) - 1) dz_AY - (L/2 - Cy) alpha_AY",
                 {steps.input("6-b", "dL"), {"alpha_AY", alpha_AY, true}, {"dz_AY", dz_AY, false}},
                 -0.5 * *m.dL - (kRoot2 - 1.0) * dz_AY - 0.5 * arm * alpha_AY,
                 false});
  return steps.mean("8", "dy_CA", {{"(i)", i, false}, {"(ii)", ii, false}});
}

double difference(Steps& steps, const char* step, const char* quantity, const RecipeInput& sum,
                  const RecipeInput& part) {
  return steps.add({step,
                    quantity,
                    "",
                    sum.name + " less " + part.name,
                    {sum, part},
                    sum.value - part.value,
                    sum.angular});
}

}  // namespace

Result<Recipe> recipe_case_1(std::span<const StepMeasurement> measured,
                             const KnownSquareness& known, const RecipeVariant& variant) {
  Diagnostics wrong = wrong_inputs(measured, kCase1, known, "Case 1");
  if (!wrong.empty()) return wrong;
  Steps steps(measured, variant);
  RecipeErrors e;
  e.alpha_AY = steps.alpha("2-a", "(13)");
  const StepMeasurement& four = steps.of("4");
  e.beta_AY = steps.add(
      {"2", "beta_AY", "(16)", "-theta/2", {steps.input("4", "theta")}, -0.5 * *four.theta, true});
  RecipeStep gamma{"2", "gamma_AY", "(16)", "phi/2", {steps.input("4", "phi")}, 0.5 * *four.phi,
                   true};
  steps.add_gamma(gamma, known.gamma_YX);
  e.gamma_AY = steps.add(std::move(gamma));
  e.beta_CA = steps.of_phi_3("3", "beta_CA", {"gamma_AY", e.gamma_AY, true}, known.gamma_YX);
  e.dz_AY = steps.add({"4",
                       "dz_AY",
                       "(16)",
                       "-dL/2 - Cy beta_AY",
                       {steps.input("4", "dL"), {"beta_AY", e.beta_AY, true}},
                       -0.5 * *four.dL - four.centre_y * e.beta_AY,
                       false});
  e.dy_CA = steps.dy_ca_of_3("5", e.alpha_AY, e.dz_AY);
  const double sum = steps.dy_sum("6", "1-a", "(10)", e.alpha_AY, known.alpha_ZY);
  e.dy_AY =
      difference(steps, "6", "dy_AY", {"dy_AY + dy_CA", sum, false}, {"dy_CA", e.dy_CA, false});
  e.dx_AY = steps.dx("7", "2-a", "(13)", e.beta_AY + e.beta_CA, known.beta_ZX);
  return std::move(steps).finish(e);
}

Result<Recipe> recipe_case_2(std::span<const StepMeasurement> measured,
                             const KnownSquareness& known, const RecipeVariant& variant) {
  Diagnostics wrong = wrong_inputs(measured, kCase2, known, "Case 2");
  if (!wrong.empty()) return wrong;
  Steps steps(measured, variant);
  RecipeErrors e;
  e.alpha_AY = steps.alpha("2-b", "(14)");
  const double beta = beta_sum(steps, e.alpha_AY);
  const double y_1a = steps.dy_sum("3 (i)", "1-a", "(10)", e.alpha_AY, known.alpha_ZY);
  const double y_1b = steps.dy_sum("3 (ii)", "1-b", "(12)", e.alpha_AY, known.alpha_ZY);
  const double y = steps.mean("3", "dy_AY + dy_CA", {{"(i)", y_1a, false}, {"(ii)", y_1b, false}});
  const double x_2a = steps.dx("4 (i)", "2-a", "(13)", beta, known.beta_ZX);
  const double x_2b = steps.dx("4 (ii)", "2-b", "(14)", beta, known.beta_ZX);
  e.dx_AY = steps.mean("4", "dx_AY", {{"(i)", x_2a, false}, {"(ii)", x_2b, false}});
  e.beta_AY = beta_ay(steps, known.beta_ZX);
  e.beta_CA = difference(steps, "5", "beta_CA", {"beta_AY + beta_CA", beta, true},
                         {"beta_AY", e.beta_AY, true});
  e.gamma_AY = steps.of_phi_3("6", "gamma_AY", {"beta_CA", e.beta_CA, true}, known.gamma_YX);
  e.dz_AY = steps.add({"7",
                       "dz_AY",
                       "(19)",
                       "-dL / (2 (sqrt(2) - 1))",
                       {steps.input("6-a", "dL")},
                       -*steps.of("6-a").dL / (2.0 * (kRoot2 - 1.0)),
                       false});
  e.dy_CA = dy_ca(steps, e.alpha_AY, e.dz_AY);
  e.dy_AY = difference(steps, "8", "dy_AY", {"dy_AY + dy_CA", y, false}, {"dy_CA", e.dy_CA, false});
  return std::move(steps).finish(e);
}

}  // namespace frustum::calibration
