// The lowest place of a function that falls and then rises, in few looks where it is smooth.
//
// Model    : the bottom of the parabola through the three lowest looks, as long as it moves less
//            than half of what the step before the last did; else golden section of the longer side
// Units    : those of the function
// Errors   : none; of a function with several valleys it finds one of them
// Accuracy : as golden_section.hpp
//            (Boost's stops at half of the digits of the place, too early for a sharp bottom)
// Source   : Brent 1973, Algorithms for Minimization without Derivatives, chapter 5
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace frustum {

struct LowestPlace {
  double at = 0.0, value = 0.0;
};

// Until the bottom is known within `narrow`, or the three lowest looks differ by `flat` at most.
template <class Function>
[[nodiscard]] LowestPlace lowest_place(const Function& f, double lo, double hi, double narrow,
                                       double flat, int most_looks = 200) {
  constexpr double kShare = 0.3819660112501051;  // (3 - sqrt(5)) / 2
  const auto look = [&](double x) { return LowestPlace{x, f(x)}; };
  LowestPlace best = look(lo + kShare * (hi - lo)), second = best, third = best;
  double step = 0.0, step_before = 0.0;
  for (int looks = 1; looks < most_looks; ++looks) {
    const double middle = 0.5 * (lo + hi);
    if (std::abs(best.at - middle) + 0.5 * (hi - lo) <= narrow) break;
    const bool is_known = second.at != best.at && third.at != best.at && third.at != second.at;
    if (is_known && std::max(second.value, third.value) - best.value <= flat) break;
    bool by_parabola = false;
    if (is_known) {
      const double r = (best.at - second.at) * (best.value - third.value);
      const double q = (best.at - third.at) * (best.value - second.value);
      const double above = (best.at - third.at) * q - (best.at - second.at) * r;
      const double below = 2.0 * (r - q);
      const double move = above / below;
      by_parabola = std::abs(move) < 0.5 * std::abs(step_before) && lo < best.at + move &&
                    best.at + move < hi;
      step_before = step;
      if (by_parabola) step = move;
    }
    if (!by_parabola) {
      step_before = best.at < middle ? hi - best.at : lo - best.at;
      step = kShare * step_before;
    }
    if (std::abs(step) < 0.5 * narrow) step = std::copysign(0.5 * narrow, step);
    const double x = best.at + step;
    if (!(lo < x && x < hi)) break;
    const LowestPlace here = look(x);
    if (here.value <= best.value) {
      (here.at < best.at ? hi : lo) = best.at;
      third = second;
      second = best;
      best = here;
      continue;
    }
    (here.at < best.at ? lo : hi) = here.at;
    if (here.value <= second.value || second.at == best.at) {
      third = second;
      second = here;
    } else if (here.value <= third.value || third.at == best.at || third.at == second.at) {
      third = here;
    }
  }
  return best;
}

}  // namespace frustum
