#include "studies/laws/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace frustum::studies {
namespace {

TEST(Quadrature, IntegratesPolynomialsToRounding) {
  for (const int nodes : {1, 2, 7, 20, 96}) {
    const Quadrature rule = over(gauss_legendre(nodes), -1.0, 2.0);
    for (int power = 0; power < 2 * nodes && power < 40; ++power) {
      double sum = 0.0;
      for (const QuadratureNode& node : rule) sum += node.weight * std::pow(node.x, power);
      const double exact = (std::pow(2.0, power + 1) - std::pow(-1.0, power + 1)) / (power + 1);
      EXPECT_NEAR(sum, exact, 1e-13 * std::abs(exact) + 1e-13) << nodes << ' ' << power;
    }
  }
}

TEST(Quadrature, TakesSquareRootsAtBothEnds) {
  double sum = 0.0;
  for (const QuadratureNode& node : over_with_roots(gauss_legendre(30), -3.0, 3.0)) {
    sum += node.weight * std::sqrt(9.0 - node.x * node.x);
  }
  EXPECT_NEAR(sum, 4.5 * std::numbers::pi, 1e-13);
}

}  // namespace
}  // namespace frustum::studies
