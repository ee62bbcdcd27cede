#include "app/job/number_check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace frustum::app {

std::function<std::string(const std::string&)> positive_number(double largest) {
  return [largest](const std::string& text) -> std::string {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool is_number = !text.empty() && *end == '\0' && std::isfinite(value);
    if (!is_number || !(value > 0.0)) return "must be a number above 0, is " + text;
    return value > largest ? fmt::format("must be at most {:g}, is {}", largest, text) : "";
  };
}

}  // namespace frustum::app
