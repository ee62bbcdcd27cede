// The inner loops of the linear engine: 16 draws at a time.
//
// Model    : arrays have a row of kLanes numbers, one a draw. Each function exists twice, for any
//            x86-64 and for AVX2; both make the same operations in the same order without fused
//            multiply-add, so that they give the same bits
// Units    : those of the caller
// Errors   : none
// Accuracy : the same bits with and without AVX2 (tests/studies/linear_engine_test.cpp)
// Source   : Philox 4x32-10, Salmon et al. 2011: the words of core/random.hpp
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace frustum::studies {

inline constexpr std::size_t kLanes = 16;

template <typename T>
struct alignas(64) LaneRow {
  std::array<T, kLanes> at{};
};

// A range's gains as they are screened: combinations of the weights (`right`), then points as sums
// of the combinations (`left`). Combinations and points come in fours.
struct ScreenFactors {
  std::size_t points = 0;
  std::size_t columns = 0;
  std::size_t rank = 0;        // a multiple of 4
  std::vector<float> left{};   // points x rank, four points interleaved: see screened()
  std::vector<float> right{};  // columns x rank
  double left_out = 0.0;       // bound of what the rank leaves out, for weights within 1
  double rounding = 0.0;       // bound of single precision's share, per length of the weights
};

struct LaneKernels {
  // lo + width u, u the uniform numbers of draws first .. first + 15 of a stream.
  void (*uniforms)(std::uint64_t seed, std::uint32_t first, std::uint64_t stream, double lo,
                   double width, LaneRow<double>& out);
  void (*turns)(const LaneRow<double>& angles, LaneRow<double>& cosines, LaneRow<double>& sines);
  // Screens of all points, their largest and least, for weights (of the live columns) over their
  // largest.
  void (*screens)(const ScreenFactors& factors, const LaneRow<float>* weights,
                  LaneRow<float>* combinations, LaneRow<float>* screens, LaneRow<float>& largest,
                  LaneRow<float>& least);
  // Places of the points that are not between the limits: point * kLanes + lane. Returns how many.
  std::size_t (*outside)(const LaneRow<float>* screens, std::size_t points,
                         const LaneRow<float>& upper, const LaneRow<float>& lower,
                         std::uint32_t* places);
  // Sum of products in 8 partial sums; count a multiple of 8.
  double (*dot)(const double* a, const double* b, std::size_t count);
};

[[nodiscard]] const LaneKernels& plain_kernels();
// With AVX2 where this processor has it.
[[nodiscard]] const LaneKernels& best_kernels();

}  // namespace frustum::studies
