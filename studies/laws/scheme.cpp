#include "studies/laws/scheme.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <boost/random/sobol.hpp>
#include <cassert>

#include "core/random.hpp"

namespace frustum::studies {
namespace {

using SobolEngine = boost::random::sobol_engine<std::uint32_t, 32>;
constexpr std::size_t kMostDimensions = boost::random::default_sobol_table::max_dimension;
constexpr std::size_t kSobolBits = 32;

// Direction numbers of all dimensions, bit after bit. Point 2^(k+1) - 1 has the Gray code 2^k, so
// it is the direction number of bit k; the engine leaves out point 0.
std::vector<std::uint32_t> directions_of(std::size_t dimensions) {
  std::vector<std::uint32_t> numbers(kSobolBits * dimensions);
  SobolEngine engine(dimensions);
  std::uint64_t next = 1;  // the point that the engine gives next
  for (std::size_t k = 0; k + 1 < kSobolBits; ++k) {
    const std::uint64_t wanted = (std::uint64_t{1} << (k + 1)) - 1;
    engine.discard((wanted - next) * dimensions);
    for (std::size_t j = 0; j < dimensions; ++j) numbers[k * dimensions + j] = engine();
    next = wanted + 1;
  }
  return numbers;
}

std::uint32_t reversed(std::uint32_t x) {
  x = ((x >> 1U) & 0x55555555U) | ((x & 0x55555555U) << 1U);
  x = ((x >> 2U) & 0x33333333U) | ((x & 0x33333333U) << 2U);
  x = ((x >> 4U) & 0x0f0f0f0fU) | ((x & 0x0f0f0f0fU) << 4U);
  x = ((x >> 8U) & 0x00ff00ffU) | ((x & 0x00ff00ffU) << 8U);
  return (x >> 16U) | (x << 16U);
}

// 64 random bits of a key; the last of the splitmix64 steps.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}

// Turns each bit or not by a hash of all bits above it (Owen's nested scrambling): below the bits
// reversed, carries and products only go upwards, so that a bit meets those that were above it.
std::uint32_t owen_scrambled(std::uint32_t x, std::uint64_t key) {
  const auto low = static_cast<std::uint32_t>(key);
  const auto high = static_cast<std::uint32_t>(key >> 32U);
  x = reversed(x);
  x ^= x * 0x3d20adeaU;
  x += low;
  x *= (high >> 16U) | 1U;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  x += high;
  x *= (low >> 16U) | 1U;
  x ^= x * 0x9c8f2d3aU;
  x ^= x * 0x1d5f8e46U;
  return reversed(x);
}

// A permutation of 0 .. 1023 of which every value can be computed alone.
std::uint32_t permuted(std::uint32_t index, std::uint64_t key) {
  constexpr std::uint32_t kHalf = 31;
  std::uint32_t left = index >> 5U, right = index & kHalf;
  for (std::uint64_t round = 0; round < 6; ++round) {
    const std::uint64_t hash = mixed(key + 32 * round + right);
    const std::uint32_t next = left ^ static_cast<std::uint32_t>(hash >> 59U);
    left = right;
    right = next;
  }
  return (left << 5U) | right;
}

constexpr std::array<std::string_view, 3> kSchemes{"random", "latin", "sobol"};

}  // namespace

struct Scheme::Directions {
  std::vector<std::uint32_t> numbers{};
};

std::string_view name_of(SchemeKind kind) { return kSchemes.at(static_cast<std::size_t>(kind)); }

std::optional<SchemeKind> scheme_named(std::string_view text) {
  for (std::size_t i = 0; i < kSchemes.size(); ++i) {
    if (text == kSchemes.at(i)) return static_cast<SchemeKind>(i);
  }
  return std::nullopt;
}

Result<Scheme> Scheme::make(SchemeKind kind, std::uint64_t seed, std::vector<std::uint64_t> streams,
                            std::uint32_t replicates) {
  assert(replicates >= 1);
  Scheme scheme;
  scheme.kind_ = kind;
  scheme.seed_ = seed;
  scheme.streams_ = std::move(streams);
  scheme.replicates_ = replicates;
  if (kind != SchemeKind::sobol) return scheme;
  if (scheme.streams_.size() > kMostDimensions) {
    return error("sobol-dimensions"_id,
                 fmt::format("the errors have {} drawn numbers, a Sobol sequence at most {}",
                             scheme.streams_.size(), kMostDimensions),
                 "use scheme = \"random\" or \"latin\"");
  }
  scheme.directions_ =
      std::make_shared<const Directions>(Directions{directions_of(scheme.streams_.size())});
  return scheme;
}

double Scheme::latin(std::uint32_t draw, std::size_t j) const {
  const std::uint32_t block = draw / kLatinBlock;
  const std::uint64_t key = mixed(mixed(mixed(seed_) ^ streams_[j]) + block) & ~std::uint64_t{0xff};
  const std::uint32_t slice = permuted(draw % kLatinBlock, key);
  const double inside = uniform({seed_, draw, RandomPurpose::error_amount}, streams_[j]);
  return (slice + inside) / kLatinBlock;
}

double Scheme::sobol(std::uint32_t draw, std::size_t j) const {
  const std::uint32_t replicate = draw % replicates_;
  const std::uint32_t i = draw / replicates_;
  std::uint32_t x = 0;
  std::size_t bit = 0;
  for (std::uint32_t gray = i ^ (i >> 1U); gray != 0; gray >>= 1U, ++bit) {
    if ((gray & 1U) != 0) x ^= directions_->numbers[bit * streams_.size() + j];
  }
  const std::uint64_t key = mixed(mixed(mixed(seed_) ^ streams_[j]) + replicate + 1);
  const double below = uniform({seed_, draw, RandomPurpose::error_amount}, streams_[j]);
  // The last of 2^-32 is not random to the last bit: u stays below 1.
  return (owen_scrambled(x, key) + below * (1.0 - 0x1p-20)) * 0x1p-32;
}

void Scheme::point(std::uint32_t draw, std::span<double> u) const {
  assert(u.size() == streams_.size());
  for (std::size_t j = 0; j < u.size(); ++j) {
    u[j] = kind_ == SchemeKind::latin ? latin(draw, j)
           : kind_ == SchemeKind::sobol
               ? sobol(draw, j)
               : uniform({seed_, draw, RandomPurpose::error_amount}, streams_[j]);
  }
}

std::optional<std::uint32_t> Scheme::group_of(std::uint32_t draw) const {
  if (kind_ == SchemeKind::random) return std::nullopt;
  return kind_ == SchemeKind::latin ? draw / kLatinBlock : draw % replicates_;
}

std::uint32_t Scheme::whole_groups(std::uint64_t n) const {
  if (kind_ == SchemeKind::random) return 0;
  if (kind_ == SchemeKind::latin) return static_cast<std::uint32_t>(n / kLatinBlock);
  return n >= replicates_ ? replicates_ : 0;
}

std::vector<std::uint32_t> sobol_point(std::uint32_t i, std::size_t dimensions) {
  const std::vector<std::uint32_t> numbers = directions_of(dimensions);
  std::vector<std::uint32_t> point(dimensions, 0);
  std::size_t bit = 0;
  for (std::uint32_t gray = i ^ (i >> 1U); gray != 0; gray >>= 1U, ++bit) {
    if ((gray & 1U) == 0) continue;
    for (std::size_t j = 0; j < dimensions; ++j) point[j] ^= numbers[bit * dimensions + j];
  }
  return point;
}

}  // namespace frustum::studies
