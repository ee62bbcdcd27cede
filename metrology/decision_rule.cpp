#include "metrology/decision_rule.hpp"

#include <algorithm>
#include <cmath>

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
  const TrueValueInterval interval = characteristic.interval.value_or(
      TrueValueInterval{characteristic.value, characteristic.value});
  // No verdict rests on what is not proven.
  if (interval.coverage == Coverage::not_proven) return Verdict::uncertain;
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
