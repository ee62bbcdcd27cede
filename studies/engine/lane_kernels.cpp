#include "studies/engine/lane_kernels.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "core/random.hpp"
#include "studies/laws/turn.hpp"

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

// Philox 4x32-10: a word of 32 bits in each 64-bit word, four lanes in a register.
struct Philox {
  static constexpr std::uint64_t kLow = 0xffffffffU;
  static constexpr std::uint64_t kFirst = 0xD2511F53U, kSecond = 0xCD9E8D57U;
  static constexpr std::uint32_t kFirstStep = 0x9E3779B9U, kSecondStep = 0xBB67AE85U;
  static constexpr int kRounds = 10;

  Words c0{}, c1{}, c2{}, c3{};

  // Lanes of draws at, at + 1, at + 2, at + 3.
  FRUSTUM_INLINE Philox(std::uint64_t stream, std::uint64_t at) {
    c0 += stream & kLow;
    c1 += stream >> 32U;
    c2 = Words{at, at + 1, at + 2, at + 3} & kLow;
    c3 += static_cast<std::uint64_t>(RandomPurpose::error_amount);
  }

  // One round, from the products of c0 and c2. What the upper halves hold then no product reads.
  FRUSTUM_INLINE void mix(const Words& p0, const Words& p1, std::uint32_t k0, std::uint32_t k1) {
    c0 = (p1 >> 32U) ^ c1 ^ static_cast<std::uint64_t>(k0);
    c1 = p1;
    c2 = (p0 >> 32U) ^ c3 ^ static_cast<std::uint64_t>(k1);
    c3 = p0;
  }

  FRUSTUM_INLINE void write(double lo, double width, double* out) const {
    // 53 bits: the first word and 21 bits of the second, put into the digits of 2^52 and 2^84 to
    // make doubles of them.
    const Words high = (c0 & kLow) | 0x4530000000000000ULL;
    const Words low = ((c1 & kLow) >> 11U) | 0x4330000000000000ULL;
    Doubles h, l;
    __builtin_memcpy(&h, &high, sizeof h);
    __builtin_memcpy(&l, &low, sizeof l);
    const Doubles number = (h - 0x1p84) * 0x1p-11 + (l - 0x1p52);
    const Doubles u = (number + 0.5) * 0x1p-53;
    *reinterpret_cast<Doubles*>(out) = lo + width * u;
  }
};

void plain_uniforms(std::uint64_t seed, std::uint32_t first, std::uint64_t stream, double lo,
                    double width, LaneRow<double>& out) {
  for (std::size_t part = 0; part < kLanes; part += 4) {
    Philox lanes(stream, std::uint64_t{first} + part);
    auto k0 = static_cast<std::uint32_t>(seed), k1 = static_cast<std::uint32_t>(seed >> 32U);
    for (int round = 0; round < Philox::kRounds; ++round) {
      lanes.mix((lanes.c0 & Philox::kLow) * Philox::kFirst,
                (lanes.c2 & Philox::kLow) * Philox::kSecond, k0, k1);
      k0 += Philox::kFirstStep;
      k1 += Philox::kSecondStep;
    }
    lanes.write(lo, width, out.at.data() + part);
  }
}

#if defined(__x86_64__)
// A product of two words of 32 bits is one instruction here, which no compiler finds by itself.
[[gnu::target("avx2")]] void wide_uniforms(std::uint64_t seed, std::uint32_t first,
                                           std::uint64_t stream, double lo, double width,
                                           LaneRow<double>& out) {
  const __m256i multiplier = _mm256_set1_epi64x(static_cast<long long>(Philox::kFirst));
  const __m256i other = _mm256_set1_epi64x(static_cast<long long>(Philox::kSecond));
  for (std::size_t part = 0; part < kLanes; part += 8) {
    // Two registers side by side: one waits while the other multiplies.
    Philox lanes(stream, std::uint64_t{first} + part);
    Philox more(stream, std::uint64_t{first} + part + 4);
    auto k0 = static_cast<std::uint32_t>(seed), k1 = static_cast<std::uint32_t>(seed >> 32U);
    for (int round = 0; round < Philox::kRounds; ++round) {
      for (Philox* p : {&lanes, &more}) {
        p->mix(
            reinterpret_cast<Words>(_mm256_mul_epu32(reinterpret_cast<__m256i>(p->c0), multiplier)),
            reinterpret_cast<Words>(_mm256_mul_epu32(reinterpret_cast<__m256i>(p->c2), other)), k0,
            k1);
      }
      k0 += Philox::kFirstStep;
      k1 += Philox::kSecondStep;
    }
    lanes.write(lo, width, out.at.data() + part);
    more.write(lo, width, out.at.data() + part + 4);
  }
}
#endif

FRUSTUM_INLINE void turns_in_lanes(const LaneRow<double>& angles, LaneRow<double>& cosines,
                                   LaneRow<double>& sines) {
  for (std::size_t l = 0; l < kLanes; ++l) {
    const CosineSine turn = cosine_sine(angles.at[l]);
    cosines.at[l] = turn.cosine;
    sines.at[l] = turn.sine;
  }
}

// Four numbers in one register of any x86-64.
using FewFloats = float __attribute__((vector_size(16), may_alias));

template <typename Vector>
FRUSTUM_INLINE Vector* vectors_of(LaneRow<float>& row) {
  return reinterpret_cast<Vector*>(row.at.data());
}
template <typename Vector>
FRUSTUM_INLINE const Vector* vectors_of(const LaneRow<float>& row) {
  return reinterpret_cast<const Vector*>(row.at.data());
}

// Four rows of products at a time, for two registers of lanes: as many sums as there are registers
// for. out[a] = sum over k of factors[stride k + a] * in[k].
template <typename Vector>
struct FourRows {
  Vector a0{}, a1{}, b0{}, b1{}, c0{}, c1{}, d0{}, d1{};

  FRUSTUM_INLINE FourRows(const float* factors, std::size_t stride, const LaneRow<float>* in,
                          std::size_t count, std::size_t place) {
    for (std::size_t k = 0; k < count; ++k) {
      const Vector x = vectors_of<Vector>(in[k])[place], y = vectors_of<Vector>(in[k])[place + 1];
      const float* f = factors + k * stride;
      a0 += f[0] * x;
      a1 += f[0] * y;
      b0 += f[1] * x;
      b1 += f[1] * y;
      c0 += f[2] * x;
      c1 += f[2] * y;
      d0 += f[3] * x;
      d1 += f[3] * y;
    }
  }

  FRUSTUM_INLINE void store(LaneRow<float>* out, std::size_t place) const {
    vectors_of<Vector>(out[0])[place] = a0;
    vectors_of<Vector>(out[0])[place + 1] = a1;
    vectors_of<Vector>(out[1])[place] = b0;
    vectors_of<Vector>(out[1])[place + 1] = b1;
    vectors_of<Vector>(out[2])[place] = c0;
    vectors_of<Vector>(out[2])[place + 1] = c1;
    vectors_of<Vector>(out[3])[place] = d0;
    vectors_of<Vector>(out[3])[place + 1] = d1;
  }
};

template <typename Vector>
FRUSTUM_INLINE Vector larger(const Vector& a, const Vector& b) {
  return a > b ? a : b;
}
template <typename Vector>
FRUSTUM_INLINE Vector lesser(const Vector& a, const Vector& b) {
  return a < b ? a : b;
}

template <typename Vector>
FRUSTUM_INLINE void screens_in_lanes(const ScreenFactors& factors, const LaneRow<float>* weights,
                                     LaneRow<float>* combinations, LaneRow<float>* screens,
                                     LaneRow<float>& largest, LaneRow<float>& least) {
  constexpr std::size_t kVectors = sizeof(LaneRow<float>) / sizeof(Vector);
  for (std::size_t place = 0; place < kVectors; place += 2) {
    for (std::size_t k = 0; k < factors.rank; k += 4) {
      const FourRows<Vector> sum(factors.right.data() + k, factors.rank, weights, factors.columns,
                                 place);
      sum.store(combinations + k, place);
    }
    Vector up0 = Vector{} - 3e38F, up1 = up0, down0 = Vector{} + 3e38F, down1 = down0;
    // Points come in fours, too: the last ones are repeated.
    for (std::size_t i = 0; i < factors.points; i += 4) {
      const FourRows<Vector> s(factors.left.data() + i * factors.rank, 4, combinations,
                               factors.rank, place);
      s.store(screens + i, place);
      up0 = larger(up0, larger(larger(s.a0, s.b0), larger(s.c0, s.d0)));
      up1 = larger(up1, larger(larger(s.a1, s.b1), larger(s.c1, s.d1)));
      down0 = lesser(down0, lesser(lesser(s.a0, s.b0), lesser(s.c0, s.d0)));
      down1 = lesser(down1, lesser(lesser(s.a1, s.b1), lesser(s.c1, s.d1)));
    }
    vectors_of<Vector>(largest)[place] = up0;
    vectors_of<Vector>(largest)[place + 1] = up1;
    vectors_of<Vector>(least)[place] = down0;
    vectors_of<Vector>(least)[place + 1] = down1;
  }
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
#define FRUSTUM_KERNELS(NAME, TARGET, UNIFORMS, VECTOR)                                         \
  struct NAME {                                                                                 \
    TARGET static void turns(const LaneRow<double>& angles, LaneRow<double>& cosines,           \
                             LaneRow<double>& sines) {                                          \
      turns_in_lanes(angles, cosines, sines);                                                   \
    }                                                                                           \
    TARGET static void screens(const ScreenFactors& factors, const LaneRow<float>* weights,     \
                               LaneRow<float>* combinations, LaneRow<float>* out,               \
                               LaneRow<float>& largest, LaneRow<float>& least) {                \
      screens_in_lanes<VECTOR>(factors, weights, combinations, out, largest, least);            \
    }                                                                                           \
    TARGET static std::size_t outside(const LaneRow<float>* screens, std::size_t points,        \
                                      const LaneRow<float>& upper, const LaneRow<float>& lower, \
                                      std::uint32_t* places) {                                  \
      return outside_in_lanes(screens, points, upper, lower, places);                           \
    }                                                                                           \
    TARGET static double dot(const double* a, const double* b, std::size_t count) {             \
      return dot_of_eight(a, b, count);                                                         \
    }                                                                                           \
    static constexpr LaneKernels table() { return {UNIFORMS, turns, screens, outside, dot}; }   \
  }

FRUSTUM_KERNELS(PlainKernels, , plain_uniforms, FewFloats);
#if defined(__x86_64__)
FRUSTUM_KERNELS(WideKernels, [[gnu::target("avx2")]], wide_uniforms, Floats);
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
