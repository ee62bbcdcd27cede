#include "metrology/decision_rule.hpp"

#include <algorithm>
#include <cmath>

#include "metrology/rounding_slack.hpp"

namespace frustum::metrology {

DecisionRule read_decision(const TomlTable& table) {
  const std::vector<std::string> names(kDecisionNames.begin(), kDecisionNames.end());
  return static_cast<DecisionRule>(table.choice_or("decision", names, 0));
}

UncertaintyInterval interval_of(const CharacteristicResult& characteristic) {
  const CharacteristicResult& c = characteristic;
  if (c.simulated) return {c.simulated->low, c.simulated->high};
  UncertaintyInterval interval{c.value - c.expanded_uncertainty, c.value + c.expanded_uncertainty};
  // Forms and zones have no nominal value.
  if (!c.nominal) interval.low = std::max(0.0, interval.low);
  return interval;
}

Verdict verdict_of(const CharacteristicResult& characteristic, DecisionRule rule) {
  const double nominal = characteristic.nominal.value_or(0.0);
  const double tolerance = characteristic.tolerance +
                           rounding_slack(characteristic.value, nominal, characteristic.tolerance);
  if (rule == DecisionRule::simple) {
    return std::abs(characteristic.value - nominal) <= tolerance ? Verdict::pass : Verdict::fail;
  }
  const UncertaintyInterval interval = interval_of(characteristic);
  const double low = interval.low - nominal;
  const double high = interval.high - nominal;
  if (low >= -tolerance && high <= tolerance) return Verdict::pass;
  if (low > tolerance || high < -tolerance) return Verdict::fail;
  return Verdict::uncertain;
}

void decide(Measurement& measurement, DecisionRule rule) {
  for (CharacteristicResult& c : measurement.characteristics) {
    const Verdict verdict = verdict_of(c, rule);
    c.pass = verdict == Verdict::pass;
    c.uncertain = verdict == Verdict::uncertain;
  }
}

}  // namespace frustum::metrology
