#include "core/decimal.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace frustum {

std::string shortest_decimal(double value) {
  std::array<char, 400> buffer;  // NOLINT: filled by to_chars; 1.8e308 has 309 digits
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed);
  return {buffer.data(), end.ptr};
}

double as_stated(double value) {
  if (!std::isfinite(value)) return value;
  const std::string digits = fmt::format("{:.14e}", value);
  double stated = 0.0;
  std::from_chars(digits.data(), digits.data() + digits.size(), stated);
  constexpr double kRoundings = 4.0 * 0.5 * std::numeric_limits<double>::epsilon();
  return std::abs(stated - value) <= kRoundings * std::abs(value) ? stated : value;
}

std::string fixed_decimal(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  if (is_zero && text.front() == '-') text.erase(0, 1);
  return text;
}

}  // namespace frustum
