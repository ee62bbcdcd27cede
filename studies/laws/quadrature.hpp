// Nodes and weights of quadrature rules.
//
// Model    : Gauss-Legendre on an interval; the same with the sine substitution, which makes square
//            roots at both ends smooth
// Units    : none
// Shape    : any number of nodes
// Errors   : none
// Accuracy : polynomials of degree 2 n - 1 to 1e-14 (tests/studies/quadrature_test.cpp)
// Source   : Newton's method on the Legendre polynomial, Abramowitz and Stegun 25.4.29
#pragma once

#include <vector>

namespace frustum::studies {

struct QuadratureNode {
  double x = 0.0;
  double weight = 0.0;
};
using Quadrature = std::vector<QuadratureNode>;

// On -1 .. 1.
[[nodiscard]] Quadrature gauss_legendre(int nodes);
[[nodiscard]] Quadrature over(const Quadrature& rule, double lo, double hi);
// x = middle + half width sin(theta), theta over -90 .. 90 deg.
[[nodiscard]] Quadrature over_with_roots(const Quadrature& rule, double lo, double hi);

}  // namespace frustum::studies
