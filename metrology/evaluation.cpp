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

// "'a', 'b' and 3 more" of those of which `holds` is true, "all characteristics"; empty: of none.
template <typename Predicate>
std::string names_of(const Measurement& measurement, Predicate holds) {
  constexpr std::size_t kNamed = 5;
  std::string names;
  std::size_t count = 0;
  for (const CharacteristicResult& c : measurement.characteristics) {
    if (holds(c) && ++count <= kNamed) names += (names.empty() ? "'" : ", '") + c.name + "'";
  }
  if (count > 1 && count == measurement.characteristics.size()) return "all characteristics";
  if (count > kNamed) names += fmt::format(" and {} more", count - kNamed);
  return names;
}

// What iso14253 cannot decide, because nothing is known of a real machine, or decides as simple
// does, because a machine makes no error.
std::optional<Diagnostic> without_uncertainty(const Measurement& measurement) {
  const std::string unknown =
      names_of(measurement, [](const auto& c) { return c.coverage() == Coverage::not_stated; });
  if (!unknown.empty()) {
    return warning("decision-without-accuracy"_id,
                   fmt::format("decision = \"iso14253\" calls {} uncertain: no accuracy is stated "
                               "of the machine that measured",
                               unknown),
                   std::string(kStateAccuracy));
  }
  const std::string ideal =
      names_of(measurement, [](const auto& c) { return !(c.expanded_uncertainty > 0.0); });
  if (ideal.empty()) return std::nullopt;
  return warning("decision-without-uncertainty"_id,
                 fmt::format("decision = \"iso14253\" goes by an uncertainty of 0 for {}", ideal),
                 std::string(kStateAccuracy));
}

// A size is what is not of either sign: the kind of its spread is known.
bool is_size(const CharacteristicResult& c) { return c.spread.is_known(); }

// U goes to the far end of the interval, which is cut at 0 first.
void state(CharacteristicResult& c, double standard, double below, double above, bool is_proven) {
  const double down = is_size(c) ? std::min(below, c.value) : below;
  c.standard_uncertainty = standard;
  c.expanded_uncertainty = std::max(down, above);
  c.interval = {c.value - down, c.value + above,
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
  const std::string names =
      names_of(measurement, [](const auto& c) { return c.coverage() == Coverage::not_proven; });
  if (names.empty()) return std::nullopt;
  return warning("coverage-not-proven"_id,
                 fmt::format("that U and interval hold the truth in 95 % of measurements is not "
                             "proven for {}: an element touches single points (om, mi, mc)",
                             names),
                 "iso14253 calls them uncertain; least-squares elements and datums are proven");
}

// Whose interval is where the simulation says that the truth is, beside the value.
std::optional<Diagnostic> corrected(const Measurement& measurement) {
  const std::string names =
      names_of(measurement, [](const auto& c) { return !c.is_value_in_interval(); });
  if (names.empty()) return std::nullopt;
  Diagnostic note = warning(
      "interval-corrected"_id,
      fmt::format("the interval of {} is corrected for a known bias of the measurement and does "
                  "not contain the value, which is not corrected: U goes from the value to its far "
                  "end",
                  names),
      "iso14253 decides by value +- U");
  note.severity = Severity::note;
  return note;
}

}  // namespace

Result<Measurement> evaluated(const InspectionPlan& plan, std::vector<FittedFeature> features,
                              const CmmModel& cmm, NoErrors mean) {
  auto measurement = evaluated_values(plan, features);
  if (!measurement) return measurement;
  const PointUncertainty u = point_uncertainty(cmm);
  const bool is_unknown = u.is_zero() && mean == NoErrors::unknown;
  for (CharacteristicResult& c : measurement->characteristics) c.is_accuracy_unknown = is_unknown;
  if (!u.is_zero()) {
    const auto uncertain = linear_uncertainty(plan, features, u);
    if (!uncertain) return uncertain.error();
    for (std::size_t i = 0; i < uncertain->standard.size(); ++i) {
      const double per_internal = unit_of(plan.characteristics[i]).per_internal;
      state(measurement->characteristics[i], per_internal * uncertain->standard[i],
            per_internal * uncertain->bounds[i].below, per_internal * uncertain->bounds[i].above,
            uncertain->is_proven[i]);
    }
  }
  if (plan.monte_carlo && u.is_zero()) {
    measurement->diagnostics.push_back(
        warning("nothing-simulated"_id,
                is_unknown ? "uncertainty: nothing was simulated, because no accuracy of the CMM "
                             "is stated"
                           : "uncertainty: nothing was simulated, because the CMM is said to have "
                             "no errors",
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
  const bool is_iso = plan.decision == DecisionRule::iso14253;
  for (auto& remark : {not_proven(*measurement), corrected(*measurement),
                       is_iso ? without_uncertainty(*measurement) : std::nullopt}) {
    if (remark) measurement->diagnostics.push_back(*remark);
  }
  return measurement;
}

}  // namespace frustum::metrology
