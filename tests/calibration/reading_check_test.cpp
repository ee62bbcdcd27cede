// Whether readings of a calibration agree, and which does not.
#include "calibration/identify/reading_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"

namespace frustum::calibration {
namespace {

// The mean of four readings, one of which is off by 1: residuals, excess and fall by hand.
TEST(ReadingCheck, NamesTheReadingThatIsOffTheMean) {
  const Eigen::MatrixXd model = Eigen::MatrixXd::Ones(4, 1);
  const Eigen::Vector4d readings(0.0, 0.0, 1.0, 0.0);
  const ReadingCheck check = reading_check(model, readings, {});
  EXPECT_NEAR(check.residuals[0], -0.25, 1e-15);
  EXPECT_NEAR(check.residuals[2], 0.75, 1e-15);
  EXPECT_EQ(check.degrees_of_freedom, 3);
  EXPECT_NEAR(check.sum_of_squares, 0.75, 1e-15);
  EXPECT_FALSE(check.consistent);
  ASSERT_EQ(check.suspects, std::vector<std::size_t>{2});
  EXPECT_NEAR(check.excess[0], 1.0, 1e-14);
  EXPECT_NEAR(check.rms_without, 0.0, 1e-7);
  EXPECT_FALSE(check.probability.has_value());
}

// Three readings of a straight line: one is wrong, and nothing says which.
TEST(ReadingCheck, SaysThatOneOfThreeIsWrongWhereNothingSeparatesThem) {
  Eigen::MatrixXd model(3, 2);
  model << 1.0, -1.0, 1.0, 0.0, 1.0, 1.0;
  const ReadingCheck check = reading_check(model, Eigen::Vector3d(0.0, 0.9, 0.0), {.noise = 1e-3});
  EXPECT_FALSE(check.consistent);
  // With one degree of freedom none can be left out.
  EXPECT_TRUE(check.suspects.empty());
  EXPECT_NEAR(check.residuals[1], 0.6, 1e-12);
  EXPECT_LT(*check.probability, 1e-12);
}

// Noise alone: chi-square as distributed, and no warning but by chance.
TEST(ReadingCheckLaws, NoiseIsNoDisagreement) {
  constexpr int kRuns = 400;
  constexpr double kNoise = 2e-4;
  const RandomKey key{.seed = 41};
  Eigen::MatrixXd model(60, 12);
  for (Eigen::Index i = 0; i < model.size(); ++i) {
    model.data()[i] = normal(key, static_cast<std::uint64_t>(i));
  }
  double sum = 0.0, low = 0.0;
  int warned = 0;
  for (std::uint32_t run = 0; run < kRuns; ++run) {
    Eigen::VectorXd readings(60);
    for (Eigen::Index i = 0; i < 60; ++i) {
      readings[i] = kNoise * normal({.seed = 42, .draw = run}, static_cast<std::uint64_t>(i));
    }
    const ReadingCheck check = reading_check(model, readings, {.noise = kNoise, .group_size = 3});
    EXPECT_EQ(check.degrees_of_freedom, 48);
    sum += check.sum_of_squares / (kNoise * kNoise);
    low += *check.probability < 0.1 ? 1.0 : 0.0;
    warned += check.consistent ? 0 : 1;
  }
  // Standard deviations of a mean of chi-squares with 48 degrees, and of a count.
  EXPECT_NEAR(sum / kRuns, 48.0, 4.0 * std::sqrt(2.0 * 48.0 / kRuns));
  EXPECT_NEAR(low / kRuns, 0.1, 4.0 * std::sqrt(0.09 / kRuns));
  EXPECT_LE(warned, 5);
}

// A group of readings that is off is found among the others, with how far.
TEST(ReadingCheckLaws, AGroupThatIsOffIsNamed) {
  constexpr double kNoise = 2e-4;
  const RandomKey key{.seed = 43};
  Eigen::MatrixXd model(60, 12);
  for (Eigen::Index i = 0; i < model.size(); ++i) {
    model.data()[i] = normal(key, static_cast<std::uint64_t>(i));
  }
  for (std::uint32_t run = 0; run < 40; ++run) {
    const auto wrong = static_cast<std::size_t>(20.0 * uniform({.seed = 44}, run));
    Eigen::VectorXd readings(60);
    for (Eigen::Index i = 0; i < 60; ++i) {
      readings[i] = kNoise * normal({.seed = 45, .draw = run}, static_cast<std::uint64_t>(i));
    }
    const Eigen::Vector3d off(5e-3, -3e-3, 2e-3);
    readings.segment<3>(static_cast<Eigen::Index>(3 * wrong)) += off;
    for (const double stated : {0.0, kNoise}) {
      const ReadingCheck check = reading_check(model, readings, {.noise = stated, .group_size = 3});
      EXPECT_FALSE(check.consistent);
      ASSERT_EQ(check.suspects, std::vector{wrong});
      EXPECT_LT((check.excess - off).norm(), 10.0 * kNoise);
    }
  }
}

}  // namespace
}  // namespace frustum::calibration
