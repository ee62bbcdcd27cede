// Legendre polynomials P_0 .. P_N.
//
// Units  : none
// Errors : none; any x, meant for [-1, 1]
#pragma once

#include <array>
#include <cstddef>

namespace frustum::metrology {

template <std::size_t N>
[[nodiscard]] constexpr std::array<double, N + 1> legendre(double x) {
  std::array<double, N + 1> p{1.0};
  if constexpr (N > 0) p[1] = x;
  for (std::size_t n = 2; n <= N; ++n) {
    const auto k = static_cast<double>(n);
    p[n] = ((2.0 * k - 1.0) * x * p[n - 1] - (k - 1.0) * p[n - 2]) / k;
  }
  return p;
}

}  // namespace frustum::metrology
