#include "studies/statistics/conformity_risk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "studies/laws/law.hpp"
#include "studies/laws/quadrature.hpp"
#include "studies/statistics/summary.hpp"

namespace frustum::studies {
namespace {

constexpr double kPriorReach = 9.0;  // standard deviations: 1e-19 of a normal law is beyond

// P(lo <= x <= hi) of a normal law, from the tail that keeps the digits.
double between(double lo, double hi, double mean, double sd) {
  const double a = (lo - mean) / sd, b = (hi - mean) / sd;
  return a > 0.0 ? normal_probability(-a) - normal_probability(-b)
                 : normal_probability(b) - normal_probability(a);
}
double outside(double lo, double hi, double mean, double sd) {
  return normal_probability((lo - mean) / sd) + normal_probability((mean - hi) / sd);
}

// Integral over a normal density of f, which is smooth between the breaks.
template <typename F>
double over_normal(double mean, double sd, std::vector<double> breaks, const F& f) {
  constexpr int kPanels = 32;
  static const Quadrature kRule = gauss_legendre(20);
  const double lo = mean - kPriorReach * sd, hi = mean + kPriorReach * sd;
  for (double& b : breaks) b = std::clamp(b, lo, hi);
  breaks.push_back(lo);
  breaks.push_back(hi);
  std::sort(breaks.begin(), breaks.end());
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double width = (breaks[i + 1] - breaks[i]) / kPanels;
    if (!(width > 0.0)) continue;
    for (int p = 0; p < kPanels; ++p) {
      const double start = breaks[i] + p * width;
      for (const QuadratureNode& node : over(kRule, start, start + width)) {
        const double z = (node.x - mean) / sd;
        sum += node.weight * std::exp(-0.5 * z * z) * f(node.x);
      }
    }
  }
  return sum / (sd * std::sqrt(2.0 * std::numbers::pi));
}

double mean_and_error(const std::vector<double>& terms, double& se) {
  const auto n = static_cast<double>(terms.size());
  const double mean = ordered_sum(terms) / n;
  const double squares = ordered_sum(terms, [&](double v) { return (v - mean) * (v - mean); });
  se = terms.size() > 1 ? std::sqrt(squares / (n - 1.0) / n) : 0.0;
  return mean;
}

}  // namespace

Risks risks_of_normal(double mean, double sd, double u, const ClosedInterval& tolerance,
                      const ClosedInterval& acceptance) {
  std::vector<double> breaks{tolerance.lo, tolerance.hi};
  for (const double end : {acceptance.lo, acceptance.hi}) {
    for (const double z : {-kPriorReach, 0.0, kPriorReach}) breaks.push_back(end + z * u);
  }
  Risks risks;
  risks.conform = between(tolerance.lo, tolerance.hi, mean, sd);
  risks.accept = between(acceptance.lo, acceptance.hi, mean, std::hypot(sd, u));
  risks.consumer = over_normal(mean, sd, breaks, [&](double y) {
    return tolerance.contains(y) ? 0.0 : between(acceptance.lo, acceptance.hi, y, u);
  });
  risks.producer = over_normal(mean, sd, breaks, [&](double y) {
    return tolerance.contains(y) ? outside(acceptance.lo, acceptance.hi, y, u) : 0.0;
  });
  return risks;
}

Risks risks_of_sample(std::span<const double> values, double u, const ClosedInterval& tolerance,
                      const ClosedInterval& acceptance) {
  assert(!values.empty() && u > 0.0);
  std::vector<double> consumer(values.size(), 0.0), producer(values.size(), 0.0);
  std::size_t conform = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double y = values[i];
    if (tolerance.contains(y)) {
      ++conform;
      producer[i] = outside(acceptance.lo, acceptance.hi, y, u);
    } else {
      consumer[i] = between(acceptance.lo, acceptance.hi, y, u);
    }
  }
  Risks risks;
  risks.conform = static_cast<double>(conform) / static_cast<double>(values.size());
  risks.consumer = mean_and_error(consumer, risks.consumer_se);
  risks.producer = mean_and_error(producer, risks.producer_se);
  risks.accept = risks.conform - risks.producer + risks.consumer;
  return risks;
}

NormalBelief after_measuring(double measured, double u) { return {measured, u}; }

NormalBelief after_measuring(double measured, double u, const NormalBelief& prior) {
  const double of_prior = 1.0 / (prior.sd * prior.sd), of_measured = 1.0 / (u * u);
  const double sum = of_prior + of_measured;
  return {(of_prior * prior.mean + of_measured * measured) / sum, 1.0 / std::sqrt(sum)};
}

double conformance_probability(const NormalBelief& belief, const ClosedInterval& tolerance) {
  return between(tolerance.lo, tolerance.hi, belief.mean, belief.sd);
}

double conformance_probability(double measured, double u, std::span<const double> population,
                               const ClosedInterval& tolerance) {
  // Likelihoods relative to the largest, so that a value far from all draws still has one.
  double nearest = std::numeric_limits<double>::infinity();
  for (const double y : population) nearest = std::min(nearest, std::abs(y - measured));
  const double largest = nearest / u;
  double all = 0.0, conform = 0.0;
  for (const double y : population) {
    const double z = (y - measured) / u;
    const double likelihood = std::exp(0.5 * (largest - z) * (largest + z));
    all += likelihood;
    if (tolerance.contains(y)) conform += likelihood;
  }
  return conform / all;
}

double acceptance_limit_for(double conformance, double u, double limit) {
  return limit - u * normal_quantile(conformance);
}

Result<DecisionRule> DecisionRule::parse(std::string_view text) {
  DecisionRule rule{.written = std::string(text)};
  if (text == "simple") return rule;
  const std::size_t blank = text.find(' ');
  const std::string_view word = text.substr(0, blank);
  std::string_view number = blank == std::string_view::npos ? "" : text.substr(blank + 1);
  const auto read = std::from_chars(number.data(), number.data() + number.size(), rule.value);
  const bool is_number = !number.empty() && read.ec == std::errc() &&
                         read.ptr == number.data() + number.size() && std::isfinite(rule.value);
  if (word == "guard") rule.kind = Kind::guard;
  if (word == "consumer") rule.kind = Kind::consumer;
  const bool is_share = rule.kind != Kind::consumer || (rule.value > 0.0 && rule.value < 1.0);
  if (rule.kind == Kind::simple || !is_number || !is_share) {
    return error("decision-rule"_id, fmt::format("'{}' is no decision rule", text),
                 "write \"simple\", \"guard 1.0\" (times U = 2 u) or \"consumer 0.005\"");
  }
  return rule;
}

ClosedInterval within(double limit, bool both_sides) {
  ClosedInterval interval{.hi = limit};
  if (both_sides) interval.lo = -limit;
  return interval;
}

double acceptance_limit(const DecisionRule& rule, std::span<const double> values, double u,
                        double limit, bool both_sides) {
  if (rule.kind == DecisionRule::Kind::simple) return limit;
  if (rule.kind == DecisionRule::Kind::guard) return limit - rule.value * 2.0 * u;
  // The consumer's risk grows with the limit of acceptance.
  std::vector<double> bad;
  for (const double y : values) {
    if (!within(limit, both_sides).contains(y)) bad.push_back(y);
  }
  const auto n = static_cast<double>(values.size());
  const auto risk = [&](double a) {
    if (both_sides && a < 0.0) return 0.0;
    const ClosedInterval accepted = within(a, both_sides);
    return ordered_sum(bad, [&](double y) { return between(accepted.lo, accepted.hi, y, u); }) / n;
  };
  const double largest =
      bad.empty()
          ? limit
          : std::max(limit, *std::max_element(bad.begin(), bad.end(), [](double a, double b) {
                       return std::abs(a) < std::abs(b);
                     }));
  double lo = (both_sides ? 0.0 : limit - 20.0 * u), hi = std::abs(largest) + kPriorReach * u;
  if (risk(hi) <= rule.value) return hi;
  // To 1e-12 of the limit, far below what any sample says.
  for (int step = 0; step < 200 && hi - lo > 1e-12 * std::abs(limit); ++step) {
    const double middle = 0.5 * (lo + hi);
    (risk(middle) <= rule.value ? lo : hi) = middle;
  }
  return lo;
}

}  // namespace frustum::studies
