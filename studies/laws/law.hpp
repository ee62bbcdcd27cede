// The law of one random number of a study: its quantiles, moments and bounds.
//
// Model    : uniform a..b; normal m, sd s, perhaps cut at m +- limit; triangular a..b with its peak
//            in the middle. A draw of the scheme `random` is that of kinematics::draw; the others
//            and correlated amounts go through the quantile: x = F^-1(u)
// Units    : those of the distribution (mm, rad)
// Errors   : none; a tolerance has been read as a law before (Distribution::read_as)
// Accuracy : quantiles 1e-15 of the width of the law for uniform and triangular ones, 1e-14 sd for
//            normal ones; moments of a cut normal law 1e-12 (tests/studies/law_test.cpp)
// Source   : closed forms; Boost.Math for the normal law
#pragma once

#include <complex>

#include "kinematics/errors/error_shape.hpp"

namespace frustum::studies {

using Law = kinematics::Distribution;

// Distribution function and quantile of the normal law with mean 0 and standard deviation 1.
[[nodiscard]] double normal_probability(double z);
[[nodiscard]] double normal_quantile(double u);

// For u in (0, 1).
[[nodiscard]] double quantile(const Law& law, double u);
[[nodiscard]] double mean(const Law& law);
[[nodiscard]] double variance(const Law& law);
// E exp(i t x)
[[nodiscard]] std::complex<double> characteristic(const Law& law, double t);
// No draw's absolute value is larger; of an uncut normal law that of 8 standard deviations, which
// one draw in 8e14 exceeds.
[[nodiscard]] double largest(const Law& law);

}  // namespace frustum::studies
