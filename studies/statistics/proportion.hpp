// A probability from k successes of n.
//
// Model    : Clopper and Pearson: the ends are the probabilities for which k or more, k or fewer
//            successes have half of 1 - confidence
// Units    : none
// Shape    : 0 <= k <= n, n >= 1
// Errors   : none
// Accuracy : 1e-12 (tests/studies/proportion_test.cpp)
// Source   : Clopper and Pearson 1934, Biometrika 26; quantiles of the beta law from Boost.Math
#pragma once

#include <array>
#include <cstdint>

namespace frustum::studies {

struct Proportion {
  std::uint64_t k = 0;
  std::uint64_t n = 0;
  double p = 0.0;
  std::array<double, 2> ci95{0.0, 1.0};
};

[[nodiscard]] std::array<double, 2> clopper_pearson(std::uint64_t k, std::uint64_t n,
                                                    double confidence = 0.95);
[[nodiscard]] Proportion proportion(std::uint64_t k, std::uint64_t n);

}  // namespace frustum::studies
