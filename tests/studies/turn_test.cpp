#include "studies/laws/turn.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace frustum::studies {
namespace {

TEST(Turn, IsThatOfTheMathematicalLibrary) {
  for (int i = -4000; i <= 4000; ++i) {
    const double angle = 0.025 * i + 1e-3 * (i % 7);
    const CosineSine turn = cosine_sine(angle);
    EXPECT_NEAR(turn.cosine, std::cos(angle), 2.5e-16) << angle;
    EXPECT_NEAR(turn.sine, std::sin(angle), 2.5e-16) << angle;
  }
}

TEST(Turn, QuartersAreRightToRounding) {
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const double angle = quarter * 1.57079632679489661923;
    const CosineSine turn = cosine_sine(angle);
    EXPECT_NEAR(turn.cosine, std::cos(angle), 2e-17 * 16) << quarter;
    EXPECT_NEAR(turn.sine, std::sin(angle), 2e-17 * 16) << quarter;
  }
}

}  // namespace
}  // namespace frustum::studies
