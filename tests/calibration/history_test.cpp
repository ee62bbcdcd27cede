// Control charts and trends against numbers that were computed elsewhere: by hand where a line of
// arithmetic does, else in Python with Student's t by numerical integration of its density.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "calibration/history/control_chart.hpp"
#include "calibration/history/trend.hpp"

namespace frustum::calibration {
namespace {

constexpr std::array kValues{10.2, 11.1, 9.7, 10.8, 10.4, 12.9, 10.1};
constexpr std::array kDays{0.0, 30.0, 61.0, 91.0, 120.0, 152.0, 181.0};

TEST(ControlChart, FindsTheLimitsOfIndividualsAndMovingRanges) {
  const auto ranges = moving_ranges(kValues);
  const std::array expected{0.9, 1.4, 1.1, 0.4, 2.5, 2.8};
  ASSERT_EQ(ranges.size(), kValues.size());
  EXPECT_FALSE(ranges[0]);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(ranges[i + 1].value(), expected[i], 1e-12);
  }
  const auto limits = control_limits(kValues);
  ASSERT_TRUE(limits);
  EXPECT_NEAR(limits->mean, 75.2 / 7.0, 1e-12);
  EXPECT_NEAR(limits->mean_moving_range, 9.1 / 6.0, 1e-12);
  EXPECT_NEAR(limits->lower, 6.708523809523807, 1e-12);
  EXPECT_NEAR(limits->upper, 14.777190476190476, 1e-12);
  EXPECT_NEAR(limits->upper_moving_range, 4.95495, 1e-12);
  EXPECT_EQ(limits->values, 7U);
}

// With five, a last value far off is beyond its own limits; with four it cannot be.
TEST(ControlChart, NeedsAsManyValuesAsLetOneBeBeyond) {
  std::vector<double> values{0.0, 0.0, 0.0, 1.0};
  EXPECT_FALSE(control_limits(values));
  const double by_hand = 0.25 + 2.66 / 3.0;
  EXPECT_GT(by_hand, values.back());
  values.insert(values.begin(), 0.0);
  const auto limits = control_limits(values);
  ASSERT_TRUE(limits);
  EXPECT_NEAR(limits->upper, 0.2 + 2.66 / 4.0, 1e-12);
  EXPECT_LT(limits->upper, values.back());
}

// Without the 2.8 from 12.9 to 10.1: 6.3 / 5.
TEST(ControlChart, HasNoRangeAcrossAnAdjustment) {
  const std::vector<bool> anew{false, false, false, false, false, false, true};
  EXPECT_FALSE(moving_ranges(kValues, anew).back());
  const auto limits = control_limits(kValues, anew);
  ASSERT_TRUE(limits);
  EXPECT_NEAR(limits->mean_moving_range, 1.26, 1e-12);
  EXPECT_FALSE(control_limits(kValues, {true, false, true, false, true, false, true}))
      << "three ranges are too few";
}

// 45.00016 has no sum of seven that is seven times it; limits of equal values are that value.
TEST(ControlChart, EqualValuesAreWithinTheirLimits) {
  for (const double value : {45.00016, 0.1, -3.3333, 12.345e6, 1e-9, 0.0}) {
    for (std::size_t count = kFewestForLimits; count < 60; ++count) {
      const auto limits = control_limits(std::vector<double>(count, value));
      ASSERT_TRUE(limits);
      EXPECT_FALSE(limits->is_beyond(value)) << count << " of " << value;
      EXPECT_FALSE(limits->is_range_beyond(0.0));
      EXPECT_LE(limits->rounding, 2e-15 * std::abs(value));
      EXPECT_TRUE(limits->is_beyond(value * (1.0 + 4e-15) + 1e-300));
      EXPECT_TRUE(limits->is_range_beyond(4e-15 * std::abs(value) + 1e-300));
    }
  }
}

// What is beyond by 1e-12 is beyond.
TEST(ControlChart, WhatIsBeyondByLittleIsBeyond) {
  const auto limits = control_limits(kValues);
  ASSERT_TRUE(limits);
  EXPECT_LT(limits->rounding, 1e-13);
  EXPECT_TRUE(limits->is_beyond(limits->upper + 1e-12));
  EXPECT_TRUE(limits->is_beyond(limits->lower - 1e-12));
  EXPECT_FALSE(limits->is_beyond(limits->upper));
  EXPECT_TRUE(limits->is_range_beyond(limits->upper_moving_range + 1e-12));
}

TEST(Trend, FindsTheSlopeAndItsInterval) {
  const auto trend = trend_of(kDays, kValues);
  ASSERT_TRUE(trend);
  EXPECT_NEAR(trend->slope, 0.004799266809728187, 1e-14);
  EXPECT_NEAR(trend->residual_sd, 1.1052910368354243, 1e-12);
  EXPECT_NEAR(trend->half_width, 0.017770454358088043, 1e-9);
  EXPECT_FALSE(trend->is_significant());
}

TEST(Trend, OfALineIsTheLine) {
  const std::array days{20000.0, 20010.0, 20040.0}, values{1.0, 2.0, 5.0};
  const auto trend = trend_of(days, values);
  ASSERT_TRUE(trend);
  EXPECT_NEAR(trend->slope, 0.1, 1e-12);
  EXPECT_LT(trend->half_width, 1e-10);
  EXPECT_TRUE(trend->is_significant());
  EXPECT_NEAR(trend->at(20020.0), 3.0, 1e-10);
}

TEST(Trend, NeedsThreeValuesAndTwoDays) {
  const std::array days{1.0, 2.0, 2.0}, same{1.0, 1.0, 1.0}, values{1.0, 2.0, 3.0};
  EXPECT_FALSE(trend_of({days.data(), 2}, {values.data(), 2}));
  EXPECT_FALSE(trend_of(same, values));
  EXPECT_TRUE(trend_of(days, values));
}

}  // namespace
}  // namespace frustum::calibration
