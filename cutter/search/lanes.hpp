// Numbers that the processor counts with at once, and vectors of them: one of each of two poses, or
// of two or four groups.
//
// Model    : what is written for lanes is compiled for two of them, which every processor has, and
//            for four; which of both runs is chosen when the program runs
// Units    : of the numbers
// Errors   : none
// Accuracy : every operation rounds as it does for one number: the same bits on every machine
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/pose.hpp"

// Functions of lanes take on the instructions of what they are part of.
#define FRUSTUM_OF_LANES [[gnu::always_inline]] inline
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define FRUSTUM_HAS_FOUR_LANES
#define FRUSTUM_FOUR_LANES [[gnu::target("avx2")]]
// What passes four lanes is always inlined: how they would be passed does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

namespace frustum::cutter {

using Both = double __attribute__((vector_size(16)));
using Four = double __attribute__((vector_size(32)));

// `two`: for tests, as on processors that have no more.
enum class LaneChoice : std::uint8_t { best, two };

// Whether four are counted with at once: where this processor does so, unless two are wanted.
[[nodiscard]] inline bool has_four_lanes([[maybe_unused]] LaneChoice lanes) {
#ifdef FRUSTUM_HAS_FOUR_LANES
  static const bool has = __builtin_cpu_supports("avx2") != 0;
  return has && lanes == LaneChoice::best;
#else
  return false;
#endif
}

// A number of each of four groups.
using FloatFour = std::array<float, 4>;
struct alignas(32) DoubleFour : std::array<double, 4> {};
[[nodiscard]] constexpr DoubleFour four_of(double x) { return {{x, x, x, x}}; }

template <class Lanes>
inline constexpr std::size_t kLanes = sizeof(Lanes) / sizeof(double);

template <class Lanes>
FRUSTUM_OF_LANES Lanes lanes_of(double x) {
  return Lanes{} + x;
}
// The lanes from number `from` on.
template <class Lanes>
FRUSTUM_OF_LANES Lanes lanes_of(const FloatFour& numbers, std::size_t from) {
  Lanes lanes;
  for (std::size_t k = 0; k < kLanes<Lanes>; ++k) lanes[k] = static_cast<double>(numbers[from + k]);
  return lanes;
}
template <class Lanes>
FRUSTUM_OF_LANES Lanes lanes_of(const DoubleFour& numbers, std::size_t from) {
  Lanes lanes;
  for (std::size_t k = 0; k < kLanes<Lanes>; ++k) lanes[k] = numbers[from + k];
  return lanes;
}
template <class Lanes>
FRUSTUM_OF_LANES void store(Lanes lanes, std::size_t from, DoubleFour& numbers) {
  for (std::size_t k = 0; k < kLanes<Lanes>; ++k) numbers[from + k] = lanes[k];
}
template <class Lanes>
FRUSTUM_OF_LANES Lanes square_root(Lanes x) {
  Lanes roots;
  for (std::size_t k = 0; k < kLanes<Lanes>; ++k) roots[k] = std::sqrt(x[k]);
  return roots;
}
// Of equal ones, and where either is no number, the second.
template <class Lanes>
FRUSTUM_OF_LANES Lanes larger(Lanes a, Lanes b) {
  return a > b ? a : b;
}
template <class Lanes>
FRUSTUM_OF_LANES Lanes smaller(Lanes a, Lanes b) {
  return a < b ? a : b;
}
template <class Lanes>
FRUSTUM_OF_LANES Lanes magnitude(Lanes x) {
  return larger(x, -x);
}
template <class Lanes>
FRUSTUM_OF_LANES Lanes within(Lanes x, Lanes half) {
  return larger(smaller(x, half), -half);
}

template <class Lanes>
struct LanesVec {
  Lanes x{}, y{}, z{};

  FRUSTUM_OF_LANES Lanes dot(const LanesVec& b) const { return x * b.x + y * b.y + z * b.z; }
  FRUSTUM_OF_LANES LanesVec cross(const LanesVec& b) const {
    return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
  }
};
template <class Lanes>
FRUSTUM_OF_LANES LanesVec<Lanes> operator+(const LanesVec<Lanes>& a, const LanesVec<Lanes>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Lanes>
FRUSTUM_OF_LANES LanesVec<Lanes> operator-(const LanesVec<Lanes>& a, const LanesVec<Lanes>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Lanes>
FRUSTUM_OF_LANES LanesVec<Lanes> operator*(Lanes a, const LanesVec<Lanes>& b) {
  return {a * b.x, a * b.y, a * b.z};
}
template <class Lanes>
FRUSTUM_OF_LANES LanesVec<Lanes> vec_of(const Vec3& v) {
  return {lanes_of<Lanes>(v.x()), lanes_of<Lanes>(v.y()), lanes_of<Lanes>(v.z())};
}
template <class Lanes, class Numbers>
FRUSTUM_OF_LANES LanesVec<Lanes> vec_of(const std::array<Numbers, 3>& v, std::size_t from) {
  return {lanes_of<Lanes>(v[0], from), lanes_of<Lanes>(v[1], from), lanes_of<Lanes>(v[2], from)};
}

}  // namespace frustum::cutter
