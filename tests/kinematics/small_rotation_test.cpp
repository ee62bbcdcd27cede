#include "kinematics/model/small_rotation.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/random.hpp"

namespace frustum::kinematics {
namespace {

double units_apart(double a, double b) {
  if (a == b) return 0.0;
  const double unit =
      std::nextafter(std::abs(b), std::numeric_limits<double>::infinity()) - std::abs(b);
  return std::abs(a - b) / unit;
}

TEST(SmallRotationLaws, SineAndCosineAreTheLibrarysWithinOneUnitInTheLastPlace) {
  std::vector<double> angles = {0.0, 1e-300, -1e-12, 0.01, -0.01, 0.00999999999, 1.0, -3.0, 1e6};
  for (std::uint64_t k = 0; k < 100000; ++k) {
    const double size = std::pow(10.0, -9.0 * uniform({.seed = 5}, 2 * k));
    angles.push_back(0.02 * size * (2.0 * uniform({.seed = 5}, 2 * k + 1) - 1.0));
  }
  for (const double angle : angles) {
    const SineCosine found = sine_cosine(angle);
    ASSERT_LE(units_apart(found.sine, std::sin(angle)), 1.0) << angle;
    ASSERT_LE(units_apart(found.cosine, std::cos(angle)), 1.0) << angle;
  }
}

TEST(SmallRotationLaws, IsTheProductOfThreeElementaryRotationsInTheGivenOrder) {
  for (std::uint64_t k = 0; k < 1000; ++k) {
    const double size = std::pow(10.0, -5.0 * uniform({.seed = 6}, 4 * k));
    const auto angle = [&](std::uint64_t i) {
      return size * (2.0 * uniform({.seed = 6}, 4 * k + i) - 1.0);
    };
    const Vec3 a(angle(1), angle(2), angle(3));
    const Mat3 x = rotation_x(a.x()), y = rotation_y(a.y()), z = rotation_z(a.z());
    EXPECT_LT((small_rotation(a, RotationOrder::zyx) - z * y * x).norm(), 2e-15);
    EXPECT_LT((small_rotation(a, RotationOrder::xyz) - x * y * z).norm(), 2e-15);
  }
}

}  // namespace
}  // namespace frustum::kinematics
