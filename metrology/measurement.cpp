#include "metrology/measurement.hpp"

#include "core/units.hpp"

namespace frustum::metrology {

double internal_value(double value, std::string_view unit) {
  if (unit == "um") return value / kUmPerMm;
  if (unit == "urad") return value / kUradPerRad;
  if (unit == "deg") return value * kRadPerDeg;
  return value;
}

double internal_value(const CharacteristicResult& characteristic) {
  return internal_value(characteristic.value, characteristic.unit);
}

bool is_angle(const CharacteristicResult& characteristic) {
  return characteristic.unit == "urad" || characteristic.unit == "deg";
}

std::string_view name_of(Coverage coverage) {
  return kCoverageNames.at(static_cast<std::size_t>(coverage));
}

std::string_view name_of(Verdict verdict) {
  return kVerdictNames.at(static_cast<std::size_t>(verdict));
}

Verdict CharacteristicResult::verdict() const {
  if (pass) return Verdict::pass;
  return uncertain ? Verdict::uncertain : Verdict::fail;
}

std::optional<Coverage> CharacteristicResult::coverage() const {
  if (is_accuracy_unknown) return Coverage::not_stated;
  return interval ? std::optional(interval->coverage) : std::nullopt;
}

bool CharacteristicResult::is_value_in_interval() const {
  return !interval || (interval->low <= value && value <= interval->high);
}

Verdict Measurement::verdict() const {
  Verdict worst = Verdict::pass;
  for (const CharacteristicResult& c : characteristics) {
    if (c.verdict() == Verdict::fail) return Verdict::fail;
    if (c.verdict() == Verdict::uncertain) worst = Verdict::uncertain;
  }
  return worst;
}

std::optional<std::size_t> Measurement::find(std::string_view characteristic) const {
  for (std::size_t i = 0; i < characteristics.size(); ++i) {
    if (characteristics[i].name == characteristic) return i;
  }
  return std::nullopt;
}

}  // namespace frustum::metrology
