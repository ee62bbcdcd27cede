// Two numbers that the processor counts with at once, and vectors of them: one of each of two
// groups.
//
// Units    : of the numbers
// Errors   : none
// Accuracy : every operation rounds as it does for one number: the same bits on every machine
#pragma once

#include <array>
#include <bit>
#include <cmath>

#include "core/pose.hpp"

// Where one instruction does it for both, and the compiler would take two and more.
#if defined(__SSE2__) && defined(__GNUC__) && !defined(__clang__)
#define FRUSTUM_BOTH_AT_ONCE
#endif

namespace frustum::cutter {

using Both = double __attribute__((vector_size(16)));
using FloatPair = std::array<float, 2>;

[[nodiscard]] inline Both both(double x) { return Both{x, x}; }
[[nodiscard]] inline Both both(const FloatPair& pair) {
#ifdef FRUSTUM_BOTH_AT_ONCE
  using Bits = long long __attribute__((vector_size(16)));
  using Floats = float __attribute__((vector_size(16)));
  return __builtin_ia32_cvtps2pd(reinterpret_cast<Floats>(Bits{std::bit_cast<long long>(pair), 0}));
#else
  return Both{pair[0], pair[1]};
#endif
}
[[nodiscard]] inline Both square_root(Both x) {
#ifdef FRUSTUM_BOTH_AT_ONCE
  return __builtin_ia32_sqrtpd(x);
#else
  return Both{std::sqrt(x[0]), std::sqrt(x[1])};
#endif
}
// Of equal ones, and where either is no number, the second.
[[nodiscard]] inline Both larger(Both a, Both b) { return a > b ? a : b; }
[[nodiscard]] inline Both smaller(Both a, Both b) { return a < b ? a : b; }
[[nodiscard]] inline Both magnitude(Both x) { return larger(x, -x); }

struct BothVec {
  Both x{}, y{}, z{};

  [[nodiscard]] Both dot(const BothVec& b) const { return x * b.x + y * b.y + z * b.z; }
  [[nodiscard]] BothVec cross(const BothVec& b) const {
    return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
  }
};
[[nodiscard]] inline BothVec operator+(const BothVec& a, const BothVec& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] inline BothVec operator-(const BothVec& a, const BothVec& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline BothVec operator*(Both a, const BothVec& b) {
  return {a * b.x, a * b.y, a * b.z};
}
[[nodiscard]] inline BothVec both(const Vec3& v) { return {both(v.x()), both(v.y()), both(v.z())}; }
[[nodiscard]] inline BothVec both(const std::array<FloatPair, 3>& v) {
  return {both(v[0]), both(v[1]), both(v[2])};
}

}  // namespace frustum::cutter
