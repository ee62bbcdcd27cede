#include "studies/laws/quadrature.hpp"

#include <cmath>
#include <numbers>

namespace frustum::studies {

Quadrature gauss_legendre(int nodes) {
  Quadrature rule(static_cast<std::size_t>(nodes));
  for (int i = 0; i < nodes; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (nodes + 0.5));
    double slope = 0.0;
    // Quadratic from a start that is right to 1 / n^2: five steps end at rounding.
    for (int step = 0; step < 6; ++step) {
      double before = 1.0, value = x;
      for (int k = 2; k <= nodes; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * before) / k;
        before = value;
        value = next;
      }
      slope = nodes * (x * value - before) / (x * x - 1.0);
      x -= value / slope;
    }
    rule[static_cast<std::size_t>(i)] = {x, 2.0 / ((1.0 - x * x) * slope * slope)};
  }
  return rule;
}

Quadrature over(const Quadrature& rule, double lo, double hi) {
  Quadrature moved = rule;
  for (QuadratureNode& node : moved) {
    node.x = 0.5 * (lo + hi) + 0.5 * (hi - lo) * node.x;
    node.weight *= 0.5 * (hi - lo);
  }
  return moved;
}

Quadrature over_with_roots(const Quadrature& rule, double lo, double hi) {
  const double half = 0.5 * (hi - lo);
  Quadrature moved = rule;
  for (QuadratureNode& node : moved) {
    const double theta = 0.5 * std::numbers::pi * node.x;
    node.x = 0.5 * (lo + hi) + half * std::sin(theta);
    node.weight *= 0.5 * std::numbers::pi * half * std::cos(theta);
  }
  return moved;
}

}  // namespace frustum::studies
