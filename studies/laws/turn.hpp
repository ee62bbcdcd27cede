// Cosine and sine of an angle, in plain arithmetic that compilers put into vector lanes.
//
// Model    : the angle less a multiple of 90 deg in three parts, then the Taylor series to the
//            terms x^17 and x^16
// Units    : rad
// Errors   : none; angles above kLargestAngle lose digits as the multiple does
// Accuracy : 2.5e-16 for angles up to 100 rad (tests/studies/turn_test.cpp); the same bits in one
//            lane and in many, with and without AVX2
// Source   : Cody and Waite, Software Manual for the Elementary Functions, 1980
#pragma once

namespace frustum::studies {

struct CosineSine {
  double cosine = 1.0;
  double sine = 0.0;
};

inline constexpr double kLargestAngle = 1e5;  // rad: the multiple has 16 bits

#if defined(__GNUC__)
__attribute__((always_inline))
#endif
inline CosineSine
cosine_sine(double angle) {
  constexpr double kQuartersPerRad = 0.63661977236758134308;
  // Adding and subtracting 1.5 * 2^52 leaves the nearest whole number.
  constexpr double kRound = 6755399441055744.0;
  // pi/2 in parts of 33, 33 and 53 bits: products with a whole number of 16 bits are exact.
  constexpr double kHigh = 1.57079632673412561417e+00;
  constexpr double kMiddle = 6.07710050630396597660e-11;
  constexpr double kLow = 2.02226624879595063154e-21;
  const double quarters = (angle * kQuartersPerRad + kRound) - kRound;
  const double x = ((angle - quarters * kHigh) - quarters * kMiddle) - quarters * kLow;
  const double y = x * x;
  double s = 1.0 / 355687428096000.0;
  s = s * y - 1.0 / 1307674368000.0;
  s = s * y + 1.0 / 6227020800.0;
  s = s * y - 1.0 / 39916800.0;
  s = s * y + 1.0 / 362880.0;
  s = s * y - 1.0 / 5040.0;
  s = s * y + 1.0 / 120.0;
  s = s * y - 1.0 / 6.0;
  s = x + x * (y * s);
  double c = 1.0 / 20922789888000.0;
  c = c * y - 1.0 / 87178291200.0;
  c = c * y + 1.0 / 479001600.0;
  c = c * y - 1.0 / 3628800.0;
  c = c * y + 1.0 / 40320.0;
  c = c * y - 1.0 / 720.0;
  c = c * y + 1.0 / 24.0;
  c = 1.0 - (0.5 * y - y * (y * c));
  // The quadrant, 0 to 3, by arithmetic alone.
  const double half = 0.5 * quarters;
  const double odd = quarters - 2.0 * (((half - 0.25) + kRound) - kRound);  // 0 or 1
  const double halves = 0.5 * (quarters - odd);
  const double turned = halves - 2.0 * (((0.5 * halves - 0.25) + kRound) - kRound);  // 0 or 1
  const double sign = 1.0 - 2.0 * turned;
  const double even = 1.0 - odd;
  return {sign * (even * c - odd * s), sign * (even * s + odd * c)};
}

}  // namespace frustum::studies
