#include "studies/lane_kernels.hpp"

#include "core/random.hpp"
#include "studies/turn.hpp"

// Vectors are passed between functions that are all inlined: no call has an ABI to differ in.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

#define FRUSTUM_INLINE [[gnu::always_inline]] inline

namespace frustum::studies {
namespace {

// Eight numbers in one register where there is one of that size, else in two.
using Floats = float __attribute__((vector_size(32), may_alias));
using Integers = std::int32_t __attribute__((vector_size(32), may_alias));
using Doubles = double __attribute__((vector_size(32), may_alias));
using LooseDoubles = double __attribute__((vector_size(32), may_alias, aligned(8)));
using Words = std::uint64_t __attribute__((vector_size(32), may_alias));
constexpr std::size_t kHalf = kLanes / 2;

FRUSTUM_INLINE const Floats* floats_of(const LaneRow<float>& row) {
  return reinterpret_cast<const Floats*>(row.at.data());
}
FRUSTUM_INLINE Floats* floats_of(LaneRow<float>& row) {
  return reinterpret_cast<Floats*>(row.at.data());
}

FRUSTUM_INLINE void uniforms_in_lanes(std::uint64_t seed, std::uint32_t first, std::uint64_t stream,
                                      double lo, double width, LaneRow<double>& out) {
  constexpr std::uint64_t kLow = 0xffffffffU;
  constexpr std::uint64_t kFirst = 0xD2511F53U, kSecond = 0xCD9E8D57U;
  constexpr std::uint32_t kFirstStep = 0x9E3779B9U, kSecondStep = 0xBB67AE85U;
  // 32 bits of the counter in each 64-bit word: four lanes in a register.
  for (std::size_t part = 0; part < kLanes; part += 4) {
    const std::uint64_t at = first + part;
    Words c0 = Words{} + (stream & kLow), c1 = Words{} + (stream >> 32U);
    Words c2 = Words{at, at + 1, at + 2, at + 3} & kLow;
    Words c3 = Words{} + static_cast<std::uint64_t>(RandomPurpose::error_amount);
    auto k0 = static_cast<std::uint32_t>(seed), k1 = static_cast<std::uint32_t>(seed >> 32U);
    for (int round = 0; round < 10; ++round) {
      const Words p0 = c0 * kFirst, p1 = c2 * kSecond;
      c0 = (p1 >> 32U) ^ c1 ^ static_cast<std::uint64_t>(k0);
      c1 = p1 & kLow;
      c2 = (p0 >> 32U) ^ c3 ^ static_cast<std::uint64_t>(k1);
      c3 = p0 & kLow;
      k0 += kFirstStep;
      k1 += kSecondStep;
    }
    // 53 bits: the first word and 21 bits of the second, put into the digits of 2^52 and 2^84
    // to make doubles of them.
    const Words high = c0 | 0x4530000000000000ULL, low = (c1 >> 11U) | 0x4330000000000000ULL;
    Doubles h, l;
    __builtin_memcpy(&h, &high, sizeof h);
    __builtin_memcpy(&l, &low, sizeof l);
    const Doubles number = (h - 0x1p84) * 0x1p-11 + (l - 0x1p52);
    const Doubles u = (number + 0.5) * 0x1p-53;
    *reinterpret_cast<Doubles*>(out.at.data() + part) = lo + width * u;
  }
}

FRUSTUM_INLINE void turns_in_lanes(const LaneRow<double>& angles, LaneRow<double>& cosines,
                                   LaneRow<double>& sines) {
  for (std::size_t l = 0; l < kLanes; ++l) {
    const CosineSine turn = cosine_sine(angles.at[l]);
    cosines.at[l] = turn.cosine;
    sines.at[l] = turn.sine;
  }
}

// Four rows of products at a time: out[a] = sum over k of factors[4 k + a] * in[k].
struct FourRows {
  Floats a0{}, a1{}, b0{}, b1{}, c0{}, c1{}, d0{}, d1{};
};
FRUSTUM_INLINE FourRows four_rows(const float* factors, std::size_t stride,
                                  const LaneRow<float>* in, std::size_t count) {
  FourRows sum;
  for (std::size_t k = 0; k < count; ++k) {
    const Floats x = floats_of(in[k])[0], y = floats_of(in[k])[1];
    const float* f = factors + k * stride;
    sum.a0 += f[0] * x;
    sum.a1 += f[0] * y;
    sum.b0 += f[1] * x;
    sum.b1 += f[1] * y;
    sum.c0 += f[2] * x;
    sum.c1 += f[2] * y;
    sum.d0 += f[3] * x;
    sum.d1 += f[3] * y;
  }
  return sum;
}

FRUSTUM_INLINE void store(const FourRows& sum, LaneRow<float>* out) {
  floats_of(out[0])[0] = sum.a0;
  floats_of(out[0])[1] = sum.a1;
  floats_of(out[1])[0] = sum.b0;
  floats_of(out[1])[1] = sum.b1;
  floats_of(out[2])[0] = sum.c0;
  floats_of(out[2])[1] = sum.c1;
  floats_of(out[3])[0] = sum.d0;
  floats_of(out[3])[1] = sum.d1;
}

FRUSTUM_INLINE Floats larger(Floats a, Floats b) { return a > b ? a : b; }
FRUSTUM_INLINE Floats lesser(Floats a, Floats b) { return a < b ? a : b; }

FRUSTUM_INLINE void screens_in_lanes(const ScreenFactors& factors, const LaneRow<float>* weights,
                                     LaneRow<float>* combinations, LaneRow<float>* screens,
                                     LaneRow<float>& largest, LaneRow<float>& least) {
  for (std::size_t k = 0; k < factors.rank; k += 4) {
    store(four_rows(factors.right.data() + k, factors.rank, weights, factors.columns),
          combinations + k);
  }
  Floats up0 = Floats{} - 3e38F, up1 = up0, down0 = Floats{} + 3e38F, down1 = down0;
  // Points come in fours, too: the last ones are repeated.
  for (std::size_t i = 0; i < factors.points; i += 4) {
    const FourRows s =
        four_rows(factors.left.data() + i * factors.rank, 4, combinations, factors.rank);
    store(s, screens + i);
    up0 = larger(up0, larger(larger(s.a0, s.b0), larger(s.c0, s.d0)));
    up1 = larger(up1, larger(larger(s.a1, s.b1), larger(s.c1, s.d1)));
    down0 = lesser(down0, lesser(lesser(s.a0, s.b0), lesser(s.c0, s.d0)));
    down1 = lesser(down1, lesser(lesser(s.a1, s.b1), lesser(s.c1, s.d1)));
  }
  floats_of(largest)[0] = up0;
  floats_of(largest)[1] = up1;
  floats_of(least)[0] = down0;
  floats_of(least)[1] = down1;
}

FRUSTUM_INLINE std::size_t outside_in_lanes(const LaneRow<float>* screens, std::size_t points,
                                            const LaneRow<float>& upper,
                                            const LaneRow<float>& lower, std::uint32_t* places) {
  const Floats up0 = floats_of(upper)[0], up1 = floats_of(upper)[1];
  const Floats down0 = floats_of(lower)[0], down1 = floats_of(lower)[1];
  std::size_t count = 0;
  for (std::size_t i = 0; i < points; ++i) {
    const Floats x = floats_of(screens[i])[0], y = floats_of(screens[i])[1];
    const Integers first = (x >= up0) | (x <= down0), second = (y >= up1) | (y <= down1);
    const Integers any = first | second;
    Words words;
    __builtin_memcpy(&words, &any, sizeof words);
    if (((words[0] | words[1]) | (words[2] | words[3])) == 0) continue;
    for (std::size_t l = 0; l < kHalf; ++l) {
      if (first[l] != 0) places[count++] = static_cast<std::uint32_t>(i * kLanes + l);
      if (second[l] != 0) places[count++] = static_cast<std::uint32_t>(i * kLanes + kHalf + l);
    }
  }
  return count;
}

FRUSTUM_INLINE double dot_of_eight(const double* a, const double* b, std::size_t count) {
  Doubles first{}, second{};
  for (std::size_t j = 0; j < count; j += 8) {
    first += *reinterpret_cast<const LooseDoubles*>(a + j) *
             *reinterpret_cast<const LooseDoubles*>(b + j);
    second += *reinterpret_cast<const LooseDoubles*>(a + j + 4) *
              *reinterpret_cast<const LooseDoubles*>(b + j + 4);
  }
  const Doubles sum = first + second;
  return (sum[0] + sum[2]) + (sum[1] + sum[3]);
}

// The same functions for one set of instructions.
#define FRUSTUM_KERNELS(NAME, TARGET)                                                           \
  struct NAME {                                                                                 \
    TARGET static void uniforms(std::uint64_t seed, std::uint32_t first, std::uint64_t stream,  \
                                double lo, double width, LaneRow<double>& out) {                \
      uniforms_in_lanes(seed, first, stream, lo, width, out);                                   \
    }                                                                                           \
    TARGET static void turns(const LaneRow<double>& angles, LaneRow<double>& cosines,           \
                             LaneRow<double>& sines) {                                          \
      turns_in_lanes(angles, cosines, sines);                                                   \
    }                                                                                           \
    TARGET static void screens(const ScreenFactors& factors, const LaneRow<float>* weights,     \
                               LaneRow<float>* combinations, LaneRow<float>* out,               \
                               LaneRow<float>& largest, LaneRow<float>& least) {                \
      screens_in_lanes(factors, weights, combinations, out, largest, least);                    \
    }                                                                                           \
    TARGET static std::size_t outside(const LaneRow<float>* screens, std::size_t points,        \
                                      const LaneRow<float>& upper, const LaneRow<float>& lower, \
                                      std::uint32_t* places) {                                  \
      return outside_in_lanes(screens, points, upper, lower, places);                           \
    }                                                                                           \
    TARGET static double dot(const double* a, const double* b, std::size_t count) {             \
      return dot_of_eight(a, b, count);                                                         \
    }                                                                                           \
    static constexpr LaneKernels table() { return {uniforms, turns, screens, outside, dot}; }   \
  }

FRUSTUM_KERNELS(PlainKernels, );
#if defined(__x86_64__)
FRUSTUM_KERNELS(WideKernels, [[gnu::target("avx2")]]);
#endif

}  // namespace

const LaneKernels& plain_kernels() {
  static const LaneKernels kTable = PlainKernels::table();
  return kTable;
}

const LaneKernels& best_kernels() {
#if defined(__x86_64__)
  static const LaneKernels kTable = WideKernels::table();
  if (__builtin_cpu_supports("avx2") != 0) return kTable;
#endif
  return plain_kernels();
}

}  // namespace frustum::studies
