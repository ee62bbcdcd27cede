#include "studies/statistics/normal_length.hpp"

#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "studies/laws/law.hpp"

namespace frustum::studies {
namespace {

Mat3 diagonal(double a, double b, double c) { return Vec3(a * a, b * b, c * c).asDiagonal(); }

TEST(NormalLength, IsChiOfEqualSpreads) {
  const boost::math::chi_squared chi(3);
  const NormalLength length(Vec3::Zero(), diagonal(2.0, 2.0, 2.0));
  for (const double p : {0.001, 0.5, 0.95, 0.9999}) {
    EXPECT_NEAR(length.quantile(p), 2.0 * std::sqrt(boost::math::quantile(chi, p)), 1e-8) << p;
  }
  EXPECT_NEAR(length.mean(), 4.0 * std::sqrt(2.0 / std::numbers::pi), 1e-12);
  EXPECT_NEAR(length.rms(), 2.0 * std::sqrt(3.0), 1e-14);
}

TEST(NormalLength, IsNonCentralChiOfAMeanAndEqualSpreads) {
  for (const double offset : {0.1, 1.0, 30.0}) {
    const boost::math::non_central_chi_squared chi(3, offset * offset);
    const NormalLength length(offset * Vec3(0.6, 0.0, 0.8), diagonal(1.0, 1.0, 1.0));
    for (const double p : {0.01, 0.5, 0.99}) {
      EXPECT_NEAR(length.quantile(p), std::sqrt(boost::math::quantile(chi, p)),
                  1e-7 * (1 + offset));
    }
  }
}

// One direction, two directions, none.
TEST(NormalLength, TakesSpreadsOfZero) {
  const NormalLength line(Vec3::Zero(), diagonal(3.0, 0.0, 0.0));
  EXPECT_NEAR(line.quantile(0.95), 3.0 * normal_quantile(0.975), 1e-8);
  EXPECT_NEAR(line.mean(), 3.0 * std::sqrt(2.0 / std::numbers::pi), 1e-11);
  const NormalLength plane(Vec3::Zero(), diagonal(2.0, 0.0, 2.0));
  EXPECT_NEAR(plane.quantile(0.5), 2.0 * std::sqrt(2.0 * std::log(2.0)), 1e-8);
  const NormalLength shifted(Vec3(0.0, 4.0, 0.0), diagonal(3.0, 0.0, 0.0));
  EXPECT_NEAR(shifted.quantile(0.95), std::hypot(4.0, 3.0 * normal_quantile(0.975)), 1e-8);
  EXPECT_EQ(NormalLength(Vec3(3.0, 4.0, 0.0), Mat3::Zero()).quantile(0.2), 5.0);
}

// Spreads from a thousandth to a thousand: quantiles against sampling, whose share below must be
// the probability asked for.
RC_GTEST_PROP(NormalLengthLaws, QuantilesAreThoseOfSamples, ()) {
  const auto number = [](double lo, double hi) {
    return lo + (hi - lo) * (*rc::gen::inRange(0, 1000001)) * 1e-6;
  };
  const Vec3 sd(std::pow(10.0, number(-3, 1)), std::pow(10.0, number(-3, 1)),
                std::pow(10.0, number(-3, 1)));
  const Vec3 mean(number(-10, 10), number(-10, 10), number(-10, 10));
  const NormalLength length(mean, diagonal(sd.x(), sd.y(), sd.z()));
  const double p = number(0.02, 0.98);
  const double q = length.quantile(p);
  RC_ASSERT(std::abs(length.probability(q) - p) < 1e-8);
  constexpr std::uint64_t kDraws = 4000;
  const auto seed = static_cast<std::uint64_t>(*rc::gen::inRange(1, 1000000));
  std::uint64_t below = 0;
  double sum = 0.0, square = 0.0;
  for (std::uint64_t i = 0; i < kDraws; ++i) {
    const RandomKey key{seed, 0};
    const Vec3 e = mean + Vec3(sd.x() * normal(key, 3 * i), sd.y() * normal(key, 3 * i + 1),
                               sd.z() * normal(key, 3 * i + 2));
    if (e.norm() <= q) ++below;
    sum += e.norm() / kDraws;
    square += e.squaredNorm() / kDraws;
  }
  const double slack = 5.0 / std::sqrt(kDraws);
  RC_ASSERT(std::abs(static_cast<double>(below) / kDraws - p) < slack * std::sqrt(p * (1 - p)));
  RC_ASSERT(std::abs(sum - length.mean()) <
            slack * std::sqrt(std::max(0.0, square - sum * sum)) + 1e-9);
}

}  // namespace
}  // namespace frustum::studies
