#include "core/golden_section.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace frustum {
namespace {

TEST(GoldenSection, FindsSmoothAndSharpBottoms) {
  const GoldenBracket smooth =
      golden_section([](double x) { return std::cosh(x - 0.3); }, -2.0, 5.0, 0.0);
  EXPECT_NEAR(smooth.at, 0.3, 1e-7);
  EXPECT_NEAR(smooth.value, 1.0, 1e-15);
  const GoldenBracket sharp =
      golden_section([](double x) { return std::abs(x - 0.3); }, -2.0, 5.0, 0.0);
  EXPECT_NEAR(sharp.at, 0.3, 1e-15);
}

TEST(GoldenSection, LooksOnceAStepAndStopsWhenNarrow) {
  int looks = 0;
  const auto rising = [&](double x) {
    ++looks;
    return x;
  };
  const GoldenBracket twenty = golden_section(rising, 0.0, 1.0, 0.0, 20);
  EXPECT_EQ(looks, 22);
  EXPECT_EQ(twenty.lo, 0.0);
  EXPECT_NEAR(twenty.hi, std::pow(0.6180339887498949, 20), 1e-12);
  EXPECT_LE(golden_section(rising, 0.0, 1.0, 1e-3).hi, 1e-3);
  EXPECT_EQ(golden_section(rising, 2.0, 2.0, 0.0).at, 2.0);
}

}  // namespace
}  // namespace frustum
