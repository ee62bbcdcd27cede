#include "core/random.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>

namespace frustum {
namespace {

TEST(Uniform, KeepsItsValuesForEver) {
  // Philox 4x32-10, worked out independently of Random123 from the paper's definition.
  const RandomKey key{.seed = 1, .draw = 0, .purpose = RandomPurpose::cmm_point};
  EXPECT_EQ(uniform(key, 0), 0x1.27bee411e0474p-4);
  EXPECT_EQ(uniform(key, 1), 0x1.0cc6764a9634cp-4);
  const RandomKey other{
      .seed = 0x123456789abcdef0, .draw = 77, .purpose = RandomPurpose::test_data};
  EXPECT_EQ(uniform(other, 0xfedcba9876543210), 0x1.33d5988e574bap-1);
}

TEST(Normal, KeepsItsValuesForEver) {
  const RandomKey key{.seed = 1, .draw = 0, .purpose = RandomPurpose::cmm_point};
  EXPECT_DOUBLE_EQ(normal(key, 0), -0.47574330034708495);
  EXPECT_DOUBLE_EQ(normal(key, 1), -0.28719614355305023);
}

TEST(Uniform, FillsTheUnitIntervalEvenly) {
  constexpr std::uint64_t kCount = 200000;
  const RandomKey key{.seed = 42};
  double sum = 0.0;
  double squares = 0.0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double u = uniform(key, i);
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += u * u;
  }
  // Five standard deviations of the two sums.
  const double n = static_cast<double>(kCount);
  EXPECT_NEAR(sum / n, 0.5, 5 * std::sqrt(1.0 / 12.0 / n));
  EXPECT_NEAR(squares / n, 1.0 / 3.0, 5 * std::sqrt(4.0 / 45.0 / n));
}

TEST(Normal, HasTheMomentsOfTheNormalDistribution) {
  constexpr std::uint64_t kCount = 200000;
  const RandomKey key{.seed = 42, .draw = 3};
  double sum = 0.0;
  double squares = 0.0;
  double fourth = 0.0;
  double neighbours = 0.0;
  double previous = 0.0;
  for (std::uint64_t i = 0; i < kCount; ++i) {
    const double z = normal(key, i);
    sum += z;
    squares += z * z;
    fourth += z * z * z * z;
    neighbours += z * previous;
    previous = z;
  }
  // Five standard deviations: Var(z) = 1, Var(z^2) = 2, Var(z^4) = 96, Var(z z') = 1.
  const double n = static_cast<double>(kCount);
  EXPECT_NEAR(sum / n, 0.0, 5 / std::sqrt(n));
  EXPECT_NEAR(squares / n, 1.0, 5 * std::sqrt(2 / n));
  EXPECT_NEAR(fourth / n, 3.0, 5 * std::sqrt(96 / n));
  EXPECT_NEAR(neighbours / n, 0.0, 5 / std::sqrt(n));
}

TEST(RandomKey, EveryPartOpensAnotherStream) {
  const RandomKey key{.seed = 1, .draw = 1, .purpose = RandomPurpose::cmm_point};
  RandomKey seed = key;
  seed.seed = 1ULL << 40;
  RandomKey draw = key;
  draw.draw = 2;
  RandomKey purpose = key;
  purpose.purpose = RandomPurpose::cmm_scale;
  const std::set<double> values{uniform(key, 0), uniform(key, 1ULL << 40), uniform(seed, 0),
                                uniform(draw, 0), uniform(purpose, 0)};
  EXPECT_EQ(values.size(), 5U);
}

RC_GTEST_PROP(RandomLaws, ADrawIsAPureFunctionOfItsKey,
              (std::uint64_t seed, std::uint32_t draw, std::uint64_t index)) {
  const RandomKey key{.seed = seed, .draw = draw};
  const double u = uniform(key, index);
  const double z = normal(key, index);
  (void)uniform(key, index + 1);
  RC_ASSERT(u == uniform(key, index));
  RC_ASSERT(z == normal(key, index));
  RC_ASSERT(u > 0.0 && u < 1.0);
  RC_ASSERT(std::isfinite(z));
}

}  // namespace
}  // namespace frustum
