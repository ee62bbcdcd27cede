#include "metrology/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>

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
    if (c.expanded_uncertainty > 0.0) continue;
    ++count;
    names += (names.empty() ? "'" : ", '") + c.name + "'";
  }
  if (count == 0) return std::nullopt;
  if (count == measurement.characteristics.size()) names = "all characteristics";
  return warning("decision-without-uncertainty"_id,
                 fmt::format("decision = \"iso14253\" goes by an uncertainty of 0 for {}", names),
                 std::string(kStateAccuracy));
}

// A size is what is not of either sign: the kind of its spread is known.
bool is_size(const CharacteristicResult& c) { return c.spread.is_known(); }

void state(CharacteristicResult& c, double standard, double below, double above, bool is_proven) {
  c.standard_uncertainty = standard;
  c.expanded_uncertainty = std::max(below, above);
  const double low = c.value - below;
  c.interval = {is_size(c) ? std::max(0.0, low) : low, c.value + above,
                !is_proven   ? Coverage::not_proven
                : is_size(c) ? Coverage::at_least_95
                             : Coverage::of_95};
}

// The simulated interval counts, but for sizes: it goes by what the shape of the part is thought to
// be, which a few equal peaks leave open, so it may lengthen their bounds, which hold whatever the
// shape is, and never shortens them.
void take(CharacteristicResult& c, SimulatedUncertainty simulated) {
  TrueValueInterval& interval = *c.interval;
  if (!is_size(c)) {
    interval.low = simulated.low;
    interval.high = simulated.high;
  } else if (c.measurand.is_known()) {
    interval.low = std::min(simulated.low, interval.low);
    interval.high = std::max(simulated.high, interval.high);
  } else {
    simulated.low = interval.low;
    simulated.high = interval.high;
  }
  if (!is_size(c) || c.measurand.is_known()) c.standard_uncertainty = simulated.standard;
  c.expanded_uncertainty = std::max(c.value - interval.low, interval.high - c.value);
  c.simulated = simulated;
}

// What the 95 % of an interval are not proven for.
std::optional<Diagnostic> not_proven(const Measurement& measurement) {
  constexpr std::size_t kNamed = 5;
  std::string names;
  std::size_t count = 0;
  for (const CharacteristicResult& c : measurement.characteristics) {
    if (!c.interval || c.interval->coverage != Coverage::not_proven) continue;
    if (++count <= kNamed) names += (names.empty() ? "'" : ", '") + c.name + "'";
  }
  if (count == 0) return std::nullopt;
  if (count > kNamed) names += fmt::format(" and {} more", count - kNamed);
  return warning("coverage-not-proven"_id,
                 fmt::format("that U and interval hold the truth in 95 % of measurements is not "
                             "proven for {}: an element touches single points (om, mi, mc)",
                             names),
                 "iso14253 calls them uncertain; least-squares elements and datums are proven");
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
    for (std::size_t i = 0; i < uncertain->standard.size(); ++i) {
      const double per_internal = evaluator_of(plan.characteristics[i].kind).per_internal;
      state(measurement->characteristics[i], per_internal * uncertain->standard[i],
            per_internal * uncertain->bounds[i].below, per_internal * uncertain->bounds[i].above,
            uncertain->is_proven[i]);
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
      take(measurement->characteristics[i], (*simulated)[i]);
    }
  }
  decide(*measurement, plan.decision);
  if (auto unproven = not_proven(*measurement)) {
    measurement->diagnostics.push_back(*std::move(unproven));
  }
  if (plan.decision == DecisionRule::iso14253) {
    if (auto undecided = without_uncertainty(*measurement)) {
      measurement->diagnostics.push_back(*std::move(undecided));
    }
  }
  return measurement;
}

}  // namespace frustum::metrology
