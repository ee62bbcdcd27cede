#include "report/number_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/decimal.hpp"

namespace frustum::report {

std::string fixed_text(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  return fixed_decimal(value, decimals);
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return "-";
  // Tenths of a second decide, so that nothing reads "60.0 s".
  if (seconds < 59.995) return fixed_text(seconds, 2) + " s";
  const auto tenths = std::llround(seconds * 10.0);
  if (tenths < 36000) {
    return fmt::format("{} min {:04.1f} s", tenths / 600, static_cast<double>(tenths % 600) / 10.0);
  }
  const auto minutes = std::llround(seconds / 60.0);
  return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
}

std::string value_text(double value, std::string_view unit) {
  if (unit == "um") return fixed_text(value, 3);
  if (unit == "mm") return fixed_text(value, 4);
  if (unit == "deg") return fixed_text(value, 5);
  if (unit == "urad") return fixed_text(value, 2);
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : "-";
}

std::string result_text(const metrology::CharacteristicResult& characteristic) {
  const std::string text = value_text(characteristic.value, characteristic.unit);
  const bool is_positive = text.find_first_of("123456789") != std::string::npos && text[0] != '-';
  return characteristic.nominal == 0.0 && is_positive ? "+" + text : text;
}

std::string nominal_text(const metrology::CharacteristicResult& characteristic) {
  if (!characteristic.nominal || *characteristic.nominal == 0.0) return "";
  return value_text(*characteristic.nominal, characteristic.unit);
}

std::string uncertainty_text(double value) {
  if (!std::isfinite(value)) return "-";
  if (value == 0.0) return "0";
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return fixed_text(value, std::clamp(1 - exponent, 0, 9));
}

std::string interval_text(const metrology::CharacteristicResult& characteristic) {
  if (!characteristic.interval) return "";
  return value_text(characteristic.interval->low, characteristic.unit) + " .. " +
         value_text(characteristic.interval->high, characteristic.unit);
}

std::string unit_symbol(std::string_view unit) {
  if (unit == "um") return "µm";
  if (unit == "urad") return "µrad";
  if (unit == "deg") return "°";
  if (unit == "mm3") return "mm³";
  return std::string(unit);
}

double deviation_of(const metrology::CharacteristicResult& characteristic) {
  return characteristic.value - characteristic.nominal.value_or(0.0);
}

std::optional<double> used_share(const metrology::CharacteristicResult& characteristic) {
  const double share = std::abs(deviation_of(characteristic)) / characteristic.tolerance;
  if (!(characteristic.tolerance > 0.0) || !std::isfinite(share)) return std::nullopt;
  return share;
}

double round_up_125(double value) {
  if (!(value > 0.0) || !std::isfinite(value)) return 1.0;
  // A value that is a step already, but for rounding, stays: 1e-9 is far above the rounding of a
  // log.
  const double decade = std::pow(10.0, std::floor(std::log10(value) + 1e-9));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (value <= factor * decade * (1.0 + 1e-9)) return factor * decade;
  }
  return 10.0 * decade;
}

std::string exact_decimal(double value) {
  if (!std::isfinite(value) || value == 0.0) return "0";  // -0 too
  return shortest_decimal(value);
}

std::string xml_decimal(double value) {
  constexpr std::size_t kDigits = 18;
  std::string text = exact_decimal(value);
  const std::size_t sign = text.front() == '-' ? 1 : 0;
  const std::size_t point = text.find('.');
  if (point == std::string::npos || text.size() - sign - 1 <= kDigits) return text;
  const std::size_t before = point - sign;
  text = fixed_decimal(value, before < kDigits ? static_cast<int>(kDigits - before) : 0);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace frustum::report
