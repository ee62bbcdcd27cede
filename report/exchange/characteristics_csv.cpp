#include "report/exchange/characteristics_csv.hpp"

#include <cmath>
#include <optional>

#include "report/exchange/csv_field.hpp"
#include "report/number_text.hpp"
#include "report/verdict.hpp"

namespace frustum::report {
namespace {

std::string number(std::optional<double> value) {
  return value && std::isfinite(*value) ? exact_decimal(*value) : std::string();
}

std::string features_of(const metrology::InspectionPlan& plan, const std::string& name) {
  std::string text;
  for (const metrology::PlannedCharacteristic& planned : plan.characteristics) {
    if (planned.name != name) continue;
    for (const std::string& feature : planned.features) text += (text.empty() ? "" : " ") + feature;
  }
  return text;
}

}  // namespace

std::string characteristics_csv(const metrology::Measurement& measurement,
                                const metrology::InspectionPlan& plan) {
  std::string csv =
      "name,kind,features,value,nominal,deviation,tolerance,expanded_uncertainty,unit,verdict,"
      "interval_low,interval_high\n";
  for (const metrology::CharacteristicResult& c : measurement.characteristics) {
    csv += csv_field(c.name) + ',' + c.kind + ',' + csv_field(features_of(plan, c.name)) + ',' +
           number(c.value) + ',' + number(c.nominal) + ',' + number(deviation_of(c)) + ',' +
           number(c.tolerance) + ',' + number(c.expanded_uncertainty) + ',' + c.unit + ',' +
           std::string(name_of(outcome_of(c))) + ',' +
           (c.simulated ? number(c.simulated->low) + ',' + number(c.simulated->high) : ",") + '\n';
  }
  return csv;
}

}  // namespace frustum::report
