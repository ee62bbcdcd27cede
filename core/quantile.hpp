// Values that a share of a sample is below.
//
// Model    : quantile: the sorted values represent the shares (i - 1/2) / n, straight between them
//            and held at the ends (Hazen's rule). nearest_rank: the least value that at least this
//            share does not exceed
// Units    : those of the values
// Shape    : at least one value; the order of the values is changed
// Errors   : none
// Accuracy : exact but for the rounding of the interpolation (tests/core/quantile_test.cpp)
// Source   : Hyndman and Fan 1996, Am. Stat. 50(4): definitions 5 and 1
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace frustum {

[[nodiscard]] inline double quantile(std::span<double> values, double share) {
  const double place = share * static_cast<double>(values.size()) - 0.5;
  const auto last = static_cast<double>(values.size() - 1);
  const double clamped = std::clamp(place, 0.0, last);
  const auto below = static_cast<std::ptrdiff_t>(clamped);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[static_cast<std::size_t>(below)];
  if (static_cast<double>(below) >= last) return low;
  const double high = *std::min_element(values.begin() + below + 1, values.end());
  return low + (clamped - static_cast<double>(below)) * (high - low);
}

[[nodiscard]] inline double nearest_rank(std::span<double> values, double share) {
  const double rank = std::ceil(share * static_cast<double>(values.size())) - 1.0;
  const auto at =
      static_cast<std::ptrdiff_t>(std::clamp(rank, 0.0, static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace frustum
