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

}  // namespace frustum::metrology
