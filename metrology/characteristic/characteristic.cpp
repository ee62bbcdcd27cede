#include "metrology/characteristic/characteristic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/decimal.hpp"
#include "metrology/characteristic/evaluators.hpp"
#include "metrology/plan/plan_names.hpp"
#include "metrology/rounding_slack.hpp"

namespace frustum::metrology {

Diagnostic without_points(const PlannedCharacteristic& planned, const std::string& feature) {
  return error(
      "feature-without-points"_id,
      fmt::format("characteristic '{}': feature '{}' has no points", planned.name, feature),
      "measure the feature, or take the characteristic out of the plan");
}

Result<CharacteristicResult> evaluate(const PlannedCharacteristic& planned,
                                      std::span<const FittedFeature> features) {
  std::vector<const FittedFeature*> chosen;
  for (const std::string& name : planned.features) {
    const auto found = std::find_if(features.begin(), features.end(), [&](const FittedFeature& f) {
      return f.planned->name == name;
    });
    if (found == features.end()) return without_points(planned, name);
    chosen.push_back(&*found);
  }
  return evaluate(planned, std::move(chosen));
}

Result<CharacteristicResult> evaluate(const PlannedCharacteristic& planned,
                                      std::vector<const FittedFeature*> named) {
  auto value = evaluator_of(planned.kind).evaluate({planned, std::move(named)});
  if (!value) {
    Diagnostics failure = std::move(value).error();
    for (Diagnostic& d : failure) {
      d.message = fmt::format("characteristic '{}': {}", planned.name, d.message);
    }
    return failure;
  }
  if (planned.deviation) {
    value->value -= *value->nominal;
    value->nominal = 0.0;
  }
  const ResultUnit unit = unit_of(planned);
  CharacteristicResult result;
  result.name = planned.name;
  result.kind = std::string(name_of(planned.kind));
  result.features = planned.features;
  result.sections = planned.sections;
  result.frame = planned.frame;
  if (planned.parameter) {
    result.parameter = kParameterNames.at(static_cast<std::size_t>(*planned.parameter));
  }
  result.floating = planned.floating;
  result.unit = std::string(unit.name);
  result.value = value->value * unit.per_internal;
  if (value->nominal) result.nominal = as_stated(*value->nominal * unit.per_internal);
  result.tolerance = as_stated(planned.tolerance * unit.per_internal);
  const double nominal = value->nominal.value_or(0.0);
  result.pass = std::abs(value->value - nominal) <=
                planned.tolerance + rounding_slack(value->value, nominal, planned.tolerance);
  result.plot_angle = std::move(value->profile.angle);
  result.plot_deviation = std::move(value->profile.deviation);
  result.profiles = std::move(value->lines);
  result.harmonics = std::move(value->harmonics);
  if (value->without_seam) {
    result.without_seam = SeamlessValue{*value->without_seam * unit.per_internal, planned.seam->at,
                                        planned.seam->within};
  }
  result.spread = std::move(value->measurand);
  if (value->has_shape) result.measurand = result.spread;
  return result;
}

}  // namespace frustum::metrology
