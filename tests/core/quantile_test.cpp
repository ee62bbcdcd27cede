#include "core/quantile.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace frustum {
namespace {

TEST(Quantile, InterpolatesBetweenTheMiddlesOfEqualShares) {
  std::vector<double> values{40.0, 10.0, 30.0, 20.0};
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 25.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.125), 10.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 15.0);
}

TEST(Quantile, IsHeldAtTheEnds) {
  std::vector<double> values{3.0, 1.0, 2.0};
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  EXPECT_EQ(quantile(values, 1.0), 3.0);
  std::vector<double> one{7.0};
  EXPECT_EQ(quantile(one, 0.3), 7.0);
}

TEST(Quantile, NearestRankIsAValueThatTheShareDoesNotExceed) {
  std::vector<double> values;
  for (int i = 100; i > 0; --i) values.push_back(i);
  EXPECT_EQ(nearest_rank(values, 0.95), 95.0);
  EXPECT_EQ(nearest_rank(values, 0.951), 96.0);
  EXPECT_EQ(nearest_rank(values, 1.0), 100.0);
}

}  // namespace
}  // namespace frustum
