// What a study says of one characteristic.
//
// Model    : mean and standard deviation by two passes, sums in blocks of 4,096 draws in the order
//            of the draws, blocks in their order; quantiles of type 7 with intervals. Intervals are
//            those of order statistics for random draws. For latin and sobol the same statistic is
//            computed in each block or replicate; the interval is the value of all draws +- t s /
//            sqrt(R), s the standard deviation of the R values, t Student's quantile for R - 1
// Units    : those of the values
// Shape    : values in the order of the draws; failed draws are left out before
// Errors   : none; what does not exist (an interval of too few draws) is absent
// Accuracy : the same bits for any distribution of blocks over threads and ranks
//            (tests/studies/summary_test.cpp)
// Source   : order_statistics.hpp; Owen, Monte Carlo theory, methods and examples, chapter 17
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "studies/statistics/order_statistics.hpp"
#include "studies/statistics/proportion.hpp"

namespace frustum::studies {

inline constexpr std::size_t kSumBlock = 4096;  // draws

// Sums of consecutive blocks, which may be computed anywhere, added in their order.
[[nodiscard]] double ordered_sum(std::span<const double> values,
                                 const std::function<double(double)>& term);
[[nodiscard]] double ordered_sum(std::span<const double> values);

struct QuantileEstimate {
  double p = 0.5;
  double value = 0.0;
  Interval ci95{};
};

struct Summary {
  std::uint64_t n = 0;
  double mean = 0.0, mean_se = 0.0;
  double sd = 0.0;
  double min = 0.0, max = 0.0;
  std::vector<QuantileEstimate> quantiles{};
};

// The probabilities that every result has.
inline constexpr double kQuantiles[] = {0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99};

// The group (block or replicate) of each value, for schemes that have them; empty: random draws.
// Values of groups that are not whole count in the statistics and not in their scatter: their
// entries are kNoGroup.
inline constexpr std::uint32_t kNoGroup = 0xffffffffU;

[[nodiscard]] Summary summary_of(std::span<const double> values,
                                 std::span<const double> probabilities = kQuantiles,
                                 std::span<const std::uint32_t> groups = {});

// P(value <= limit) or, of a signed deviation, P(|value| <= limit).
[[nodiscard]] Proportion conforming(std::span<const double> values, double limit);
[[nodiscard]] Proportion conforming_both_sides(std::span<const double> values, double limit);

// Standard error of a statistic from its values in R groups, and its interval about `value`.
struct ScatterEstimate {
  double se = 0.0;
  Interval ci95{};  // absent with less than two groups
};
[[nodiscard]] ScatterEstimate scatter(double value, std::span<const double> of_groups);

// Student's quantile for 95 % two-sided.
[[nodiscard]] double student_95(std::uint32_t degrees);

// Draws after which a stop rule is looked at: 4096 * 2^k.
[[nodiscard]] bool is_stop_count(std::uint64_t n);
// Half of the interval's width; nothing where an end is absent.
[[nodiscard]] std::optional<double> half_width(const Interval& interval);

}  // namespace frustum::studies
