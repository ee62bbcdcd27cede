#include "metrology/decision_rule.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "metrology/rounding_slack.hpp"

namespace frustum::metrology {

DecisionRule read_decision(const TomlTable& table) {
  const std::vector<std::string> names(kDecisionNames.begin(), kDecisionNames.end());
  return static_cast<DecisionRule>(table.choice_or("decision", names, 0));
}

Verdict verdict_of(const CharacteristicResult& characteristic, DecisionRule rule) {
  const double nominal = characteristic.nominal.value_or(0.0);
  const double tolerance = characteristic.tolerance +
                           rounding_slack(characteristic.value, nominal, characteristic.tolerance);
  if (rule == DecisionRule::simple) {
    return std::abs(characteristic.value - nominal) <= tolerance ? Verdict::pass : Verdict::fail;
  }
  // This rule decides by nothing that is not proven or not known.
  const std::optional<Coverage> coverage = characteristic.coverage();
  if (coverage == Coverage::not_proven || coverage == Coverage::not_stated) {
    return Verdict::uncertain;
  }
  const double low = characteristic.value - characteristic.expanded_uncertainty - nominal;
  const double high = characteristic.value + characteristic.expanded_uncertainty - nominal;
  // Of a size, which has no nominal, value - U may be below 0: it has no lower limit.
  const bool is_above_lower = !characteristic.nominal || low >= -tolerance;
  if (is_above_lower && high <= tolerance) return Verdict::pass;
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
