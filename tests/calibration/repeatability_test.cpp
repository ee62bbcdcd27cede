#include "calibration/identify/repeatability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/random.hpp"

namespace frustum::calibration {
namespace {

const std::vector<Row> kRows{{"a", "A", false}, {"b", "A", false}, {"t", "A", true}};

Eigen::MatrixXd covariance() {
  Eigen::MatrixXd s(3, 3);
  s << 1e-6, 5e-7, 0.0, 5e-7, 4e-6, 0.0, 0.0, 0.0, 1e-12;
  return s;
}

TEST(Repeatability, KeepsTheMeasuringMachineWherePartsScatterLess) {
  const std::vector<Eigen::VectorXd> parts{Eigen::Vector3d(0.010, 0.020, 1e-6),
                                           Eigen::Vector3d(0.0101, 0.0199, 1.1e-6)};
  const auto result = pool(kRows, parts, covariance());
  ASSERT_TRUE(result);
  EXPECT_NEAR(result->mean[0], 0.01005, 1e-15);
  EXPECT_EQ(result->covariance, covariance());
  EXPECT_FALSE(result->degrees_of_freedom);
  EXPECT_NEAR(result->scatter[0], 0.0001 / std::sqrt(2.0), 1e-12);
}

TEST(Repeatability, TakesTheScatterWhereItIsLargerByKind) {
  const std::vector<Eigen::VectorXd> parts{Eigen::Vector3d(0.000, 0.000, 1.0e-6),
                                           Eigen::Vector3d(0.010, 0.020, 1.1e-6)};
  const auto result = pool(kRows, parts, covariance());
  ASSERT_TRUE(result);
  // s^2 / sigma^2 = 50 and 50: q = sqrt(50), over sqrt(2): 5.
  EXPECT_NEAR(result->scatter_lengths, std::sqrt(50.0), 1e-12);
  EXPECT_NEAR(result->covariance(0, 0), 25e-6, 1e-16);
  EXPECT_NEAR(result->covariance(0, 1), 25.0 * 5e-7, 1e-16);  // correlation kept
  EXPECT_EQ(result->covariance(2, 2), 1e-12);
  EXPECT_EQ(result->degrees_of_freedom, 2.0);
}

// Ten parts of a machine that repeats to four times the measuring uncertainty: the pooled standard
// deviation of the mean is right on average.
TEST(Repeatability, StatesTheScatterOfTheMean) {
  double stated = 0.0;
  double seen = 0.0;
  constexpr int kDraws = 500;
  for (std::uint32_t draw = 0; draw < kDraws; ++draw) {
    const RandomKey key{20, draw, RandomPurpose::test_data};
    std::vector<Eigen::VectorXd> parts;
    std::uint64_t index = 0;
    for (int p = 0; p < 10; ++p) {
      Eigen::VectorXd part(3);
      part << 4e-3 * normal(key, index), 8e-3 * normal(key, index + 1), 0.0;
      index += 2;
      parts.push_back(part);
    }
    const auto result = pool(kRows, parts, covariance());
    stated += result->covariance(0, 0) / kDraws;
    seen += result->mean[0] * result->mean[0] / kDraws;
  }
  EXPECT_NEAR(stated, 1.6e-6, 0.05e-6);
  EXPECT_NEAR(seen, 1.6e-6, 0.4e-6);
}

TEST(Repeatability, TakesOnePartAsItIsAndRefusesNone) {
  const std::vector<Eigen::VectorXd> one{Eigen::Vector3d(1, 2, 3)};
  EXPECT_EQ(pool(kRows, one, covariance())->covariance, covariance());
  EXPECT_FALSE(pool(kRows, {}, covariance()));
  const std::vector<Eigen::VectorXd> uneven{Eigen::Vector3d(1, 2, 3), Eigen::Vector2d(1, 2)};
  EXPECT_FALSE(pool(kRows, uneven, covariance()));
  const std::vector<Eigen::VectorXd> infinite{
      Eigen::Vector3d(1, 2, std::numeric_limits<double>::infinity())};
  EXPECT_FALSE(pool(kRows, infinite, covariance()));
  EXPECT_FALSE(pool(kRows, one, Eigen::MatrixXd::Zero(3, 3)));
}

}  // namespace
}  // namespace frustum::calibration
