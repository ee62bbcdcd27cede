#include "app/job/number_list.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "core/counted.hpp"

namespace frustum::app {
namespace {

// mm or degrees: a thousand kilometres. Farther away numbers are more than 0.1 um apart.
constexpr double kFarthest = 1e9;

Result<std::vector<double>> parsed(const std::string& text, const std::string& what,
                                   const std::string& expected) {
  std::vector<double> numbers;
  std::size_t start = 0;
  while (start <= text.size()) {
    const std::size_t comma = std::min(text.find(',', start), text.size());
    const std::size_t first = std::min(text.find_first_not_of(' ', start), comma);
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data() + first, text.data() + comma, value);
    const bool whole =
        std::string_view(end, text.data() + comma).find_first_not_of(' ') == std::string_view::npos;
    if (status != std::errc{} || !whole || !std::isfinite(value)) {
      return error(
          "not-a-number"_id,
          fmt::format("'{}' in {} is not a number", text.substr(start, comma - start), what),
          fmt::format("expected {} separated by commas", expected));
    }
    if (std::abs(value) > kFarthest) {
      return error("out-of-range"_id,
                   fmt::format("{} in {}: expected at most {:g}", value, what, kFarthest));
    }
    numbers.push_back(value);
    start = comma + 1;
  }
  return numbers;
}

}  // namespace

Result<std::vector<double>> numbers_of(const std::string& text, std::size_t count,
                                       const std::string& what) {
  auto numbers = parsed(text, what, counted(count, "number"));
  if (numbers && numbers->size() != count) {
    return error("number-count"_id, fmt::format("{} has {}, expected {}", what,
                                                counted(numbers->size(), "number"), count));
  }
  return numbers;
}

Result<std::vector<double>> number_list(const std::string& text, const std::string& what) {
  return parsed(text, what, "numbers");
}

}  // namespace frustum::app
