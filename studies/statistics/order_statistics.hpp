// Quantiles of a sample and what it says of those of the population.
//
// Model    : quantile of type 7: the sorted values x_0 .. x_{n-1} straight between them at the
//            place p (n - 1). Interval: x_(l) .. x_(u) of the order statistics 1 .. n, each of the
//            two binomial tails at most half of 1 - confidence; no rank where the tail of the first
//            or last is larger. Wilks: the least number of draws whose largest covers a share of
//            the population. Band of Dvoretzky, Kiefer, Wolfowitz (Massart's constant) about an
//            empirical distribution function
// Units    : those of the values
// Shape    : n >= 1, sorted in ascending order where `sorted` is said
// Errors   : none
// Accuracy : ranks exact, quantiles to rounding (tests/studies/order_statistics_test.cpp)
// Source   : Hyndman and Fan 1996, Am. Stat. 50(4), definition 7; David and Nagaraja, Order
//            Statistics, section 7.1; Wilks 1941; Massart 1990
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace frustum::studies {

// Two ends, of which either may not exist.
struct OrderRanks {
  std::optional<std::uint64_t> lower{};  // 1 .. n
  std::optional<std::uint64_t> upper{};
};

inline constexpr double kConfidence = 0.95;

// Ascending, on all cores.
void sort_values(std::vector<double>& values);
[[nodiscard]] double sorted_quantile(std::span<const double> sorted, double p);
// The same of values in any order, whose order is changed.
[[nodiscard]] double unsorted_quantile(std::span<double> values, double p);
[[nodiscard]] OrderRanks order_ranks(std::uint64_t n, double p, double confidence = kConfidence);

struct Interval {
  std::optional<double> lo{};
  std::optional<double> hi{};
};
[[nodiscard]] Interval quantile_interval(std::span<const double> sorted, double p,
                                         double confidence = kConfidence);

// Draws whose largest value exceeds that of a share `coverage` of the population, with confidence.
[[nodiscard]] std::uint64_t wilks_draws(double coverage, double confidence);
// Half width of the band about an empirical distribution function.
[[nodiscard]] double dkw_half_width(std::uint64_t n, double confidence = kConfidence);

}  // namespace frustum::studies
