#include "studies/laws/law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.hpp"
#include "kinematics/errors/error_draw.hpp"

namespace frustum::studies {
namespace {

Law law_of(const char* text) {
  const auto law = kinematics::parse_distribution(text);
  EXPECT_TRUE(law) << text;
  return law->read_as(kinematics::ToleranceReading::uniform);
}

const char* const kLaws[] = {"uniform -3um..7um", "normal 2um sd 1um",
                             "normal 2um sd 1um limit 1.5um", "triangular -1um..5um",
                             "nominal 2um tolerance 3um as normal-3sd-cut"};

TEST(Law, NormalQuantilesAreThoseOfTables) {
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile(0.5), 0.0, 1e-16);
  EXPECT_NEAR(normal_quantile(1e-10), -6.361340902404056, 1e-13);
  EXPECT_NEAR(normal_probability(-3.0), 1.349898031630095e-3, 1e-17);
}

// By the mean over many slices of u, which knows nothing of densities.
TEST(Law, MomentsAreThoseOfTheQuantiles) {
  constexpr int kSlices = 400000;
  for (const char* text : kLaws) {
    const Law law = law_of(text);
    double sum = 0.0, squares = 0.0;
    std::complex<double> turn = 0.0;
    for (int i = 0; i < kSlices; ++i) {
      const double x = quantile(law, (i + 0.5) / kSlices);
      sum += x / kSlices;
      squares += x * x / kSlices;
      turn += std::polar(1.0 / kSlices, 700.0 * x);
    }
    // Midpoints leave 1e-5 of the variance of a normal law's tails, less of the others.
    EXPECT_NEAR(mean(law), sum, 1e-10) << text;
    EXPECT_NEAR(variance(law), squares - sum * sum, 2e-5 * variance(law)) << text;
    EXPECT_NEAR(std::abs(characteristic(law, 700.0) - turn), 0.0, 1e-5) << text;
  }
}

// Kolmogorov's distance of 20,000 draws from the quantile's law.
TEST(Law, DrawsHaveTheLawOfTheQuantile) {
  constexpr std::size_t kDraws = 20000;
  for (const char* text : kLaws) {
    const Law law = law_of(text);
    const RandomKey key{3, 0, RandomPurpose::error_amount};
    std::vector<double> draws(kDraws);
    for (std::size_t i = 0; i < kDraws; ++i) draws[i] = kinematics::drawn_from(law, key, 7 * i);
    std::sort(draws.begin(), draws.end());
    double distance = 0.0;
    for (std::size_t i = 1; i < 1000; ++i) {
      const double x = quantile(law, static_cast<double>(i) / 1000.0);
      const auto below = std::lower_bound(draws.begin(), draws.end(), x) - draws.begin();
      distance = std::max(distance, std::abs(static_cast<double>(below) / kDraws -
                                             static_cast<double>(i) / 1000.0));
    }
    EXPECT_LT(distance, 1.95 / std::sqrt(kDraws)) << text;  // 1 in 1,000
  }
}

TEST(Law, LargestIsABoundOfDraws) {
  EXPECT_DOUBLE_EQ(largest(law_of("uniform -3um..7um")), 7e-3);
  EXPECT_DOUBLE_EQ(largest(law_of("normal 2um sd 1um limit 1.5um")), 3.5e-3);
  EXPECT_DOUBLE_EQ(largest(law_of("normal -2um sd 1um")), 10e-3);
  EXPECT_DOUBLE_EQ(largest(law_of("triangular -9um..5um")), 9e-3);
}

}  // namespace
}  // namespace frustum::studies
