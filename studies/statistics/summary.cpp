#include "studies/statistics/summary.hpp"

#include <algorithm>
#include <bit>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>

namespace frustum::studies {
namespace {

// Values of each group, in the order of the groups.
std::vector<std::vector<double>> by_group(std::span<const double> values,
                                          std::span<const std::uint32_t> groups) {
  std::vector<std::vector<double>> parts;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (groups[i] == kNoGroup) continue;
    if (groups[i] >= parts.size()) parts.resize(groups[i] + std::size_t{1});
    parts[groups[i]].push_back(values[i]);
  }
  std::erase_if(parts, [](const std::vector<double>& part) { return part.empty(); });
  return parts;
}

double mean_of(std::span<const double> values) {
  return ordered_sum(values) / static_cast<double>(values.size());
}

}  // namespace

double ordered_sum(std::span<const double> values, const std::function<double(double)>& term) {
  double sum = 0.0;
  for (std::size_t first = 0; first < values.size(); first += kSumBlock) {
    double block = 0.0;
    for (const double v : values.subspan(first, std::min(kSumBlock, values.size() - first))) {
      block += term(v);
    }
    sum += block;
  }
  return sum;
}

double ordered_sum(std::span<const double> values) {
  double sum = 0.0;
  for (std::size_t first = 0; first < values.size(); first += kSumBlock) {
    double block = 0.0;
    for (const double v : values.subspan(first, std::min(kSumBlock, values.size() - first))) {
      block += v;
    }
    sum += block;
  }
  return sum;
}

double student_95(std::uint32_t degrees) {
  return boost::math::quantile(boost::math::students_t(degrees), 0.5 + 0.5 * kConfidence);
}

ScatterEstimate scatter(double value, std::span<const double> of_groups) {
  if (of_groups.size() < 2) return {};
  const auto n = static_cast<double>(of_groups.size());
  const double mean = mean_of(of_groups);
  const double squares = ordered_sum(of_groups, [&](double v) { return (v - mean) * (v - mean); });
  const double se = std::sqrt(squares / (n - 1.0) / n);
  const double reach = student_95(static_cast<std::uint32_t>(of_groups.size() - 1)) * se;
  return {se, {value - reach, value + reach}};
}

Summary summary_of(std::span<const double> values, std::span<const double> probabilities,
                   std::span<const std::uint32_t> groups) {
  assert(!values.empty() && (groups.empty() || groups.size() == values.size()));
  Summary summary{.n = values.size()};
  const auto n = static_cast<double>(values.size());
  summary.mean = mean_of(values);
  const double mean = summary.mean;
  const double squares = ordered_sum(values, [&](double v) { return (v - mean) * (v - mean); });
  summary.sd = values.size() > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0;
  summary.mean_se = summary.sd / std::sqrt(n);
  std::vector<double> sorted(values.begin(), values.end());
  sort_values(sorted);
  summary.min = sorted.front();
  summary.max = sorted.back();
  std::vector<std::vector<double>> parts;
  if (!groups.empty()) {
    parts = by_group(values, groups);
    std::vector<double> means;
    for (std::vector<double>& part : parts) {
      means.push_back(mean_of(part));
      std::sort(part.begin(), part.end());
    }
    summary.mean_se = scatter(mean, means).se;
  }
  for (const double p : probabilities) {
    QuantileEstimate q{.p = p, .value = sorted_quantile(sorted, p)};
    if (groups.empty()) {
      q.ci95 = quantile_interval(sorted, p);
    } else {
      std::vector<double> of_groups;
      for (const std::vector<double>& part : parts) of_groups.push_back(sorted_quantile(part, p));
      q.ci95 = scatter(q.value, of_groups).ci95;
    }
    summary.quantiles.push_back(q);
  }
  return summary;
}

Proportion conforming(std::span<const double> values, double limit) {
  const auto k = std::count_if(values.begin(), values.end(), [&](double v) { return v <= limit; });
  return proportion(static_cast<std::uint64_t>(k), values.size());
}

Proportion conforming_both_sides(std::span<const double> values, double limit) {
  const auto k =
      std::count_if(values.begin(), values.end(), [&](double v) { return std::abs(v) <= limit; });
  return proportion(static_cast<std::uint64_t>(k), values.size());
}

bool is_stop_count(std::uint64_t n) { return n >= kSumBlock && std::has_single_bit(n); }

std::optional<double> half_width(const Interval& interval) {
  if (!interval.lo || !interval.hi) return std::nullopt;
  return 0.5 * (*interval.hi - *interval.lo);
}

}  // namespace frustum::studies
