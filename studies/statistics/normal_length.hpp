// The length of a normal vector in space: its distribution function, quantiles and mean, exactly.
//
// Model    : E ~ N(m, C) in three directions. On the principal axes of C,
//              P(|E| <= r) = integral over the two axes of least spread of the probability that the
//              third stays within what is left of r
//            mean |E| = 1/(2 sqrt(pi)) integral of (1 - E exp(-t |E|^2)) t^(-3/2) dt; mean square
//            |m|^2 + trace C. Quadrature by Gauss-Legendre with the sine substitution, which takes
//            the square roots at the ends away, over 9 standard deviations
// Units    : those of the vector
// Shape    : C positive semidefinite; also of rank 0, 1 and 2
// Errors   : none
// Accuracy : probabilities 1e-10, quantiles 1e-8 of the root mean square
//            (tests/studies/normal_length_test.cpp: closed forms, other formulas, sampling)
// Source   : Imhof 1961, Biometrika 48, for the quantity; conditional quadrature: ours; mean:
//            Mathai and Provost, Quadratic Forms in Random Variables, section 3.2b
#pragma once

#include "core/pose.hpp"

namespace frustum::studies {

class NormalLength {
 public:
  NormalLength(const Vec3& mean, const Mat3& covariance);

  [[nodiscard]] double probability(double r) const;  // P(|E| <= r)
  [[nodiscard]] double quantile(double p) const;
  [[nodiscard]] double mean() const;
  [[nodiscard]] double rms() const;

 private:
  Vec3 mean_;  // on the principal axes, largest spread first
  Vec3 sd_;
};

}  // namespace frustum::studies
