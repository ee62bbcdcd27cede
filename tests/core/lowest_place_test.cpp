#include "core/lowest_place.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace frustum {
namespace {

constexpr double kNarrow = 1e-13;

TEST(LowestPlace, TakesFewLooksWhereTheBottomIsSmooth) {
  int looks = 0;
  const LowestPlace bottom = lowest_place(
      [&](double x) {
        ++looks;
        return std::cosh(x - 0.3);
      },
      -2.0, 5.0, kNarrow, 1e-14);
  EXPECT_NEAR(bottom.at, 0.3, 1e-7);
  EXPECT_NEAR(bottom.value, 1.0, 1e-14);
  EXPECT_LE(looks, 15);
}

TEST(LowestPlace, FindsSharpBottomsAndEnds) {
  const auto skew = [](double x) { return x < 0.3 ? 0.1 * (0.3 - x) : 3.0 * (x - 0.3); };
  EXPECT_NEAR(lowest_place(skew, -2.0, 5.0, kNarrow, 0.0).at, 0.3, 1e-12);
  const auto corner = [](double x) { return std::max((x - 0.3) * (x - 1.3), 2.0 * (x - 0.3)); };
  EXPECT_NEAR(lowest_place(corner, -2.0, 5.0, kNarrow, 0.0).value, 0.0, 1e-12);
  EXPECT_NEAR(lowest_place([](double x) { return x; }, 0.0, 1.0, kNarrow, 0.0).at, 0.0, 1e-12);
  EXPECT_NEAR(lowest_place([](double x) { return -x; }, 0.0, 1.0, kNarrow, 0.0).at, 1.0, 1e-12);
}

TEST(LowestPlace, EndsOnALevelFunctionAndInNoRoom) {
  int looks = 0;
  const auto level = [&](double) {
    ++looks;
    return 1.0;
  };
  EXPECT_EQ(lowest_place(level, 0.0, 1.0, kNarrow, 0.0).value, 1.0);
  EXPECT_LE(looks, 5);
  EXPECT_EQ(lowest_place(level, 2.0, 2.0, kNarrow, 0.0).at, 2.0);
  looks = 0;
  static_cast<void>(lowest_place(level, 0.0, 1.0, kNarrow, -1.0, 20));
  EXPECT_LE(looks, 20);
}

}  // namespace
}  // namespace frustum
