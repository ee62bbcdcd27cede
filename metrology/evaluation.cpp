#include "metrology/evaluation.hpp"

#include <fmt/format.h>

#include "metrology/characteristic/evaluators.hpp"
#include "metrology/decision_rule.hpp"
#include "metrology/uncertainty/linear_uncertainty.hpp"
#include "metrology/uncertainty/monte_carlo_uncertainty.hpp"

namespace frustum::metrology {
namespace {

constexpr std::string_view kStateAccuracy =
    "state its accuracy: inspection.cmm of a job, or --e0 and --l-per-um of frustum measure";

// iso14253 decides by the uncertainty: without one it is no stricter than simple.
std::optional<Diagnostic> without_uncertainty(const Measurement& measurement) {
  std::string names;
  std::size_t count = 0;
  for (const CharacteristicResult& c : measurement.characteristics) {
    if (c.simulated || c.expanded_uncertainty > 0.0) continue;
    ++count;
    names += (names.empty() ? "'" : ", '") + c.name + "'";
  }
  if (count == 0) return std::nullopt;
  if (count == measurement.characteristics.size()) names = "all characteristics";
  return warning("decision-without-uncertainty"_id,
                 fmt::format("decision = \"iso14253\" goes by an uncertainty of 0 for {}", names),
                 std::string(kStateAccuracy));
}

}  // namespace

Result<Measurement> evaluated(const InspectionPlan& plan, std::vector<FittedFeature> features,
                              const CmmModel& cmm) {
  auto measurement = evaluated_values(plan, features);
  if (!measurement) return measurement;
  const PointUncertainty u = point_uncertainty(cmm);
  if (!u.is_zero()) {
    const auto uncertain = linear_uncertainty(plan, features, u);
    if (!uncertain) return uncertain.error();
    constexpr double kCoverage = 2.0;  // 95 % of a normal distribution
    for (std::size_t i = 0; i < uncertain->standard.size(); ++i) {
      CharacteristicResult& c = measurement->characteristics[i];
      c.expanded_uncertainty = kCoverage * uncertain->standard[i] *
                               evaluator_of(plan.characteristics[i].kind).per_internal;
    }
  }
  if (plan.monte_carlo && u.is_zero()) {
    measurement->diagnostics.push_back(
        warning("nothing-simulated"_id,
                "uncertainty: nothing was simulated, because the CMM is said to have no errors",
                std::string(kStateAccuracy)));
  } else if (plan.monte_carlo) {
    const auto simulated = simulated_uncertainties(
        plan, features, error_draws(cmm, plan.monte_carlo->seed), *plan.monte_carlo);
    if (!simulated) return simulated.error();
    for (std::size_t i = 0; i < simulated->size(); ++i) {
      measurement->characteristics[i].simulated = (*simulated)[i];
    }
  }
  decide(*measurement, plan.decision);
  if (plan.decision == DecisionRule::iso14253) {
    if (auto undecided = without_uncertainty(*measurement)) {
      measurement->diagnostics.push_back(*std::move(undecided));
    }
  }
  return measurement;
}

}  // namespace frustum::metrology
