#include "report/exchange/characteristics_csv.hpp"

#include <cmath>
#include <optional>
#include <unordered_map>

#include "report/csv_field.hpp"
#include "report/form_parameter.hpp"
#include "report/number_text.hpp"
#include "report/verdict.hpp"

namespace frustum::report {
namespace {

std::string number(std::optional<double> value) {
  return value && std::isfinite(*value) ? exact_decimal(*value) : std::string();
}

// None where nothing is stated of the machine.
std::string uncertainty_field(const metrology::CharacteristicResult& c) {
  return c.is_accuracy_unknown ? std::string() : number(c.expanded_uncertainty);
}

std::string coverage_field(const metrology::CharacteristicResult& c) {
  const auto found = c.coverage();
  return found ? std::string(metrology::name_of(*found)) : std::string();
}

// By the name of the characteristic, separated by blanks.
std::unordered_map<std::string_view, std::string> features_by_name(
    const metrology::InspectionPlan& plan) {
  std::unordered_map<std::string_view, std::string> found;
  for (const metrology::PlannedCharacteristic& planned : plan.characteristics) {
    std::string& text = found[planned.name];
    for (const std::string& feature : planned.features) text += (text.empty() ? "" : " ") + feature;
  }
  return found;
}

}  // namespace

std::string characteristics_csv(const metrology::Measurement& measurement,
                                const metrology::InspectionPlan& plan) {
  std::string csv =
      "name,kind,features,value,nominal,deviation,tolerance,expanded_uncertainty,unit,verdict,"
      "interval_low,interval_high,coverage\n";
  const auto features = features_by_name(plan);
  for (const metrology::CharacteristicResult& c : measurement.characteristics) {
    const auto named = features.find(c.name);
    csv += csv_field(c.name) + ',' + kind_text(c) + ',' +
           csv_field(named == features.end() ? std::string() : named->second) + ',' +
           number(c.value) + ',' + number(c.nominal) + ',' + number(deviation_of(c)) + ',' +
           number(c.tolerance) + ',' + uncertainty_field(c) + ',' + c.unit + ',' +
           std::string(name_of(outcome_of(c))) + ',' +
           (c.interval ? number(c.interval->low) + ',' + number(c.interval->high) : ",") + ',' +
           coverage_field(c) + '\n';
  }
  return csv;
}

}  // namespace frustum::report
