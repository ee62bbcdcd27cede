#include "studies/answers/allocation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace frustum::studies {
namespace {

using Logarithms = std::vector<double>;  // of the factors' ratios to the first

struct Vertex {
  Logarithms at{};
  double cost = 0.0;
};

std::vector<double> factors_of(const Logarithms& ratios) {
  std::vector<double> factors{1.0};
  for (const double ratio : ratios) factors.push_back(std::exp(ratio));
  return factors;
}

// The least of a function by the simplex of Nelder and Mead, from the origin.
template <typename F>
Vertex least_of(std::size_t dimensions, const F& cost) {
  // Ratios of 1.3; ends where the costs agree to 1e-6, a hundredth of what the optimum means.
  constexpr double kFirstStep = 0.26;
  constexpr double kSameCost = 1e-6;
  std::vector<Vertex> simplex(dimensions + 1);
  for (std::size_t i = 0; i <= dimensions; ++i) {
    simplex[i].at.assign(dimensions, 0.0);
    if (i > 0) simplex[i].at[i - 1] = kFirstStep;
    simplex[i].cost = cost(simplex[i].at);
  }
  const auto cheaper = [](const Vertex& a, const Vertex& b) { return a.cost < b.cost; };
  for (std::size_t step = 0; step < 100 * dimensions; ++step) {
    std::stable_sort(simplex.begin(), simplex.end(), cheaper);
    Vertex& worst = simplex.back();
    if (worst.cost - simplex.front().cost <= kSameCost * simplex.front().cost) break;
    Logarithms middle(dimensions, 0.0);
    for (std::size_t i = 0; i < dimensions; ++i) {
      for (std::size_t k = 0; k < dimensions; ++k) {
        middle[k] += simplex[i].at[k] / static_cast<double>(dimensions);
      }
    }
    const auto along = [&](double t) {
      Vertex moved{middle};
      for (std::size_t k = 0; k < dimensions; ++k) {
        moved.at[k] += t * (worst.at[k] - middle[k]);
      }
      moved.cost = cost(moved.at);
      return moved;
    };
    Vertex next = along(-1.0);
    if (next.cost < simplex.front().cost) {
      Vertex further = along(-2.0);
      worst = further.cost < next.cost ? std::move(further) : std::move(next);
      continue;
    }
    if (next.cost < simplex[dimensions - 1].cost) {
      worst = std::move(next);
      continue;
    }
    next = along(next.cost < worst.cost ? -0.5 : 0.5);
    if (next.cost < worst.cost) {
      worst = std::move(next);
      continue;
    }
    for (std::size_t i = 1; i <= dimensions; ++i) {
      for (std::size_t k = 0; k < dimensions; ++k) {
        simplex[i].at[k] = 0.5 * (simplex[i].at[k] + simplex.front().at[k]);
      }
      simplex[i].cost = cost(simplex[i].at);
    }
  }
  return *std::min_element(simplex.begin(), simplex.end(), cheaper);
}

}  // namespace

OneFactor one_factor(std::span<const double> sorted, double probability, double limit) {
  OneFactor one{limit / sorted_quantile(sorted, probability)};
  const Interval interval = quantile_interval(sorted, probability);
  if (interval.hi) one.ci95.lo = limit / *interval.hi;
  if (interval.lo) one.ci95.hi = limit / *interval.lo;
  return one;
}

Allocation allocate(const ScaledValues& values, std::span<const double> costs, double probability,
                    double limit) {
  assert(!costs.empty());
  // The factors along a direction that bring the quantile to the limit.
  const auto scaled = [&](std::vector<double> factors) {
    std::vector<double> drawn = values(factors);
    const double scale = limit / unsorted_quantile(drawn, probability);
    for (double& factor : factors) factor *= scale;
    return factors;
  };
  const auto cost_of = [&](std::span<const double> factors) {
    double cost = 0.0;
    for (std::size_t g = 0; g < costs.size(); ++g) cost += costs[g] / factors[g];
    return cost;
  };
  Allocation allocation;
  const std::vector<double> equal = scaled(std::vector<double>(costs.size(), 1.0));
  allocation.equal_factor = equal.front();
  allocation.equal_cost = cost_of(equal);
  const Vertex best = least_of(costs.size() - 1, [&](const Logarithms& ratios) {
    return cost_of(scaled(factors_of(ratios)));
  });
  allocation.factors = scaled(factors_of(best.at));
  allocation.cost = cost_of(allocation.factors);
  return allocation;
}

AllowedTolerances closed_form_tolerances(std::span<const double> gains,
                                         std::span<const double> costs, double deviation_allowed) {
  AllowedTolerances allowed;
  double square = 0.0;
  for (std::size_t j = 0; j < gains.size(); ++j) {
    allowed.limits.push_back(std::cbrt(costs[j] / (gains[j] * gains[j])));
    square += gains[j] * gains[j] * allowed.limits[j] * allowed.limits[j];
  }
  const double scale = 3.0 * deviation_allowed / std::sqrt(square);
  for (std::size_t j = 0; j < gains.size(); ++j) {
    allowed.limits[j] *= scale;
    allowed.cost += costs[j] / allowed.limits[j];
  }
  return allowed;
}

}  // namespace frustum::studies
