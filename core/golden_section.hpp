// The lowest place of a function that falls and then rises, by golden section.
//
// Model    : two looks inside the bracket, placed so that one of them serves the next bracket too;
//            each step leaves 0.618 of it. Of equal looks the right one is kept
// Units    : those of the function
// Errors   : none; of a function with several valleys it finds one of them
// Accuracy : a smooth bottom is distinguished from its neighbours down to the root of rounding, a
//            sharp one down to rounding
// Source   : Kiefer 1953
#pragma once

#include <utility>

namespace frustum {

struct GoldenBracket {
  double lo = 0.0, hi = 0.0;
  double at = 0.0, value = 0.0;  // the lower of the two looks inside
  [[nodiscard]] double middle() const { return 0.5 * (lo + hi); }
};

// Until the bracket is no wider than `narrow`, or has no two places between its ends, but no more
// than `most_steps`.
template <class Function>
[[nodiscard]] GoldenBracket golden_section(const Function& f, double lo, double hi, double narrow,
                                           int most_steps = 200) {
  constexpr double kShare = 0.6180339887498949;  // (sqrt(5) - 1) / 2
  double a = hi - kShare * (hi - lo), b = lo + kShare * (hi - lo);
  double at_a = f(a), at_b = f(b);
  for (int step = 0; step < most_steps && hi - lo > narrow; ++step) {
    if (!(lo < a && a < b && b < hi)) break;
    if (at_a < at_b) {
      hi = b;
      b = std::exchange(a, hi - kShare * (hi - lo));
      at_b = std::exchange(at_a, f(a));
    } else {
      lo = a;
      a = std::exchange(b, lo + kShare * (hi - lo));
      at_a = std::exchange(at_b, f(b));
    }
  }
  return at_a < at_b ? GoldenBracket{lo, hi, a, at_a} : GoldenBracket{lo, hi, b, at_b};
}

}  // namespace frustum
