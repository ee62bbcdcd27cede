#include "studies/statistics/order_statistics.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <boost/math/special_functions/beta.hpp>
#include <cassert>
#include <cmath>

namespace frustum::studies {
namespace {

// P(B <= k) of a binomial B with n trials of probability p, k < n.
double at_most(std::uint64_t k, std::uint64_t n, double p) {
  return boost::math::ibetac(static_cast<double>(k) + 1.0, static_cast<double>(n - k), p);
}
// P(B >= k), k >= 1.
double at_least(std::uint64_t k, std::uint64_t n, double p) {
  return boost::math::ibeta(static_cast<double>(k), static_cast<double>(n - k) + 1.0, p);
}

struct Place {
  std::size_t below = 0;
  double share = 0.0;
};

Place place_of(std::size_t n, double p) {
  const double place = std::clamp(p, 0.0, 1.0) * static_cast<double>(n - 1);
  const auto below = static_cast<std::size_t>(place);
  return {below, place - static_cast<double>(below)};
}

}  // namespace

void sort_values(std::vector<double>& values) { tbb::parallel_sort(values.begin(), values.end()); }

double sorted_quantile(std::span<const double> sorted, double p) {
  assert(!sorted.empty());
  const Place place = place_of(sorted.size(), p);
  if (place.below + 1 >= sorted.size()) return sorted.back();
  return sorted[place.below] + place.share * (sorted[place.below + 1] - sorted[place.below]);
}

double unsorted_quantile(std::span<double> values, double p) {
  assert(!values.empty());
  const Place place = place_of(values.size(), p);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(place.below);
  std::nth_element(values.begin(), at, values.end());
  if (place.below + 1 >= values.size()) return *at;
  const double next = *std::min_element(at + 1, values.end());
  return *at + place.share * (next - *at);
}

OrderRanks order_ranks(std::uint64_t n, double p, double confidence) {
  const double tail = 0.5 * (1.0 - confidence);
  OrderRanks ranks;
  // The quantile is below x_(l) if fewer than l values are below it: P(B <= l - 1).
  std::uint64_t in = 0, out = n + 1;  // the largest l with P(B <= l - 1) <= tail
  while (out - in > 1) {
    const std::uint64_t l = in + (out - in) / 2;
    (at_most(l - 1, n, p) <= tail ? in : out) = l;
  }
  if (in >= 1) ranks.lower = in;
  // It is above x_(u) if at least u values are below it: P(B >= u).
  out = 0;
  in = n + 1;  // the least u with P(B >= u) <= tail
  while (in - out > 1) {
    const std::uint64_t u = out + (in - out) / 2;
    (at_least(u, n, p) <= tail ? in : out) = u;
  }
  if (in <= n) ranks.upper = in;
  return ranks;
}

Interval quantile_interval(std::span<const double> sorted, double p, double confidence) {
  const OrderRanks ranks = order_ranks(sorted.size(), p, confidence);
  Interval interval;
  if (ranks.lower) interval.lo = sorted[*ranks.lower - 1];
  if (ranks.upper) interval.hi = sorted[*ranks.upper - 1];
  return interval;
}

std::uint64_t wilks_draws(double coverage, double confidence) {
  auto draws =
      static_cast<std::uint64_t>(std::floor(std::log(1.0 - confidence) / std::log(coverage)));
  while (1.0 - std::pow(coverage, static_cast<double>(draws)) < confidence) ++draws;
  return draws;
}

double dkw_half_width(std::uint64_t n, double confidence) {
  return std::sqrt(std::log(2.0 / (1.0 - confidence)) / (2.0 * static_cast<double>(n)));
}

}  // namespace frustum::studies
