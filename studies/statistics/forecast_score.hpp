// How good a normal forecast N(m, s) of a quantity was whose true value y has become known.
//
// Model    : with z = (y - m) / s
//              CRPS      s (z (2 Phi(z) - 1) + 2 phi(z) - 1 / sqrt(pi))
//              interval  u - l + 40 (l - y)+ + 40 (y - u)+, l and u = m -+ 1.96 s
//              log       ln s + z^2 / 2 + ln(2 pi) / 2
//            each is least, on average, for who states what they believe
// Units    : those of y, m and s, which agree
// Shape    : one forecast a call
// Errors   : none; s > 0
// Accuracy : rounding (tests/studies/forecast_score_test.cpp)
// Source   : Gneiting, Raftery 2007, J. Am. Stat. Assoc. 102, 359-378
#pragma once

namespace frustum::studies {

struct Forecast {
  double mean = 0.0;
  double sd = 1.0;
};

// The quantile of a normal distribution that 95 % are within on either side.
inline constexpr double kTwoSided95 = 1.959963984540054;

[[nodiscard]] double crps(const Forecast& forecast, double truth);
[[nodiscard]] double interval_score_95(const Forecast& forecast, double truth);
[[nodiscard]] double log_score(const Forecast& forecast, double truth);

// CRPS that is expected of a forecast that is right: sd / sqrt(pi).
[[nodiscard]] double expected_crps(double sd);

}  // namespace frustum::studies
