#include "report/exchange/exact_decimal.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace frustum::report {

std::string exact_decimal(double value) {
  if (!std::isfinite(value) || value == 0.0) return "0";  // -0 too
  std::array<char, 1100> text;                            // the smallest double has 1074 decimals
  const auto [end, status] =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
  return status == std::errc{} ? std::string(text.data(), end) : "0";
}

}  // namespace frustum::report
