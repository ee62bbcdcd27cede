#include "core/pose.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/random.hpp"

namespace frustum {
namespace {

constexpr double kPi = std::numbers::pi;

// Poses over a machine's volume: identity, tiny and random ones, the seed chosen by the property.
Pose sample_pose(std::uint64_t seed) {
  const RandomKey key{.seed = seed};
  const Vec3 direction(normal(key, 0), normal(key, 1), normal(key, 2));
  const double size = seed % 3 == 0 ? 1e-9 : 1.0;
  const double angle = (uniform(key, 3) - 0.5) * 2.0 * kPi * size;
  const Vec3 shift(normal(key, 4), normal(key, 5), normal(key, 6));
  return {rotation_about(direction.normalized(), angle), shift * 500.0 * size};
}

double distance(const Pose& a, const Pose& b) {
  return (a.rotation - b.rotation).cwiseAbs().maxCoeff() +
         (a.translation - b.translation).cwiseAbs().maxCoeff();
}

// Products of a few rounded operations on coordinates up to about 2000 mm.
constexpr double kRounding = 1e-11;

RC_GTEST_PROP(PoseLaws, APoseAndItsInverseCancel, (std::uint64_t seed)) {
  const Pose pose = sample_pose(seed);
  RC_ASSERT(distance(pose * pose.inverse(), Pose{}) < kRounding);
  RC_ASSERT(distance(pose.inverse() * pose, Pose{}) < kRounding);
}

RC_GTEST_PROP(PoseLaws, ProductsAssociate, (std::uint64_t a, std::uint64_t b, std::uint64_t c)) {
  const Pose first = sample_pose(a);
  const Pose second = sample_pose(b);
  const Pose third = sample_pose(c);
  RC_ASSERT(distance((first * second) * third, first * (second * third)) < kRounding);
}

RC_GTEST_PROP(PoseLaws, AProductMovesPointsOneAfterTheOther, (std::uint64_t a, std::uint64_t b)) {
  const Pose outer = sample_pose(a);
  const Pose inner = sample_pose(b);
  const Vec3 p(1.0, -20.0, 300.0);
  RC_ASSERT(((outer * inner).point(p) - outer.point(inner.point(p))).norm() < kRounding);
  RC_ASSERT(((outer * inner).direction(p) - outer.direction(inner.direction(p))).norm() <
            kRounding);
}

RC_GTEST_PROP(PoseLaws, RotationsAreOrthonormal, (std::uint64_t seed)) {
  const Mat3 rotation = sample_pose(seed).rotation;
  RC_ASSERT((rotation * rotation.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff() < 1e-12);
  RC_ASSERT(std::abs(rotation.determinant() - 1.0) < 1e-12);
}

TEST(Pose, IsTheIdentityByDefault) {
  EXPECT_EQ(distance(Pose{}, Pose::translated(Vec3::Zero())), 0.0);
  EXPECT_EQ(distance(Pose{}, Pose::rotated(Mat3::Identity())), 0.0);
}

TEST(Pose, TurnsThenShifts) {
  const Pose pose{rotation_z(kPi / 2), Vec3(10, 20, 30)};
  EXPECT_LT((pose.point(Vec3(1, 0, 0)) - Vec3(10, 21, 30)).norm(), 1e-14);
  EXPECT_LT((pose.direction(Vec3(1, 0, 0)) - Vec3(0, 1, 0)).norm(), 1e-15);
}

TEST(Rotation, IsRightHandedAboutEachAxis) {
  EXPECT_LT((rotation_x(kPi / 2) * Vec3::UnitY() - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((rotation_y(kPi / 2) * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-15);
  EXPECT_LT((rotation_z(kPi / 2) * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
  const Vec3 diagonal = Vec3::Ones().normalized();
  EXPECT_LT((rotation_about(diagonal, 2 * kPi / 3) * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
}

TEST(AngleBetween, IsExactForTinyAndNearlyStraightAngles) {
  for (const double angle : {1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 0.5, kPi / 2, 3.0}) {
    const Vec3 turned = rotation_z(angle) * Vec3::UnitX();
    EXPECT_NEAR(angle_between(Vec3::UnitX(), turned), angle, 4e-16 * (1.0 + angle)) << angle;
    EXPECT_NEAR(angle_between(-Vec3::UnitX(), turned), kPi - angle, 1e-15) << angle;
  }
  EXPECT_EQ(angle_between(Vec3::UnitY(), Vec3::UnitY()), 0.0);
  EXPECT_DOUBLE_EQ(angle_between(Vec3::UnitY(), -Vec3::UnitY()), kPi);
}

TEST(UnitVec3, HasLengthOneForVectorsOfAnySize) {
  for (const double size : {1e-290, 1e-160, 1.0, 1e160, 1e300}) {
    const auto unit = UnitVec3::of(Vec3(1, -2, 2) * size);
    ASSERT_TRUE(unit) << size;
    EXPECT_NEAR(unit->vec().norm(), 1.0, 3e-16) << size;
    EXPECT_NEAR(unit->vec().z(), 2.0 / 3.0, 3e-16) << size;
  }
}

TEST(UnitVec3, IsNothingForVectorsWithoutADirection) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(UnitVec3::of(Vec3::Zero()));
  EXPECT_FALSE(UnitVec3::of(Vec3(1e-305, 0, 0)));
  EXPECT_FALSE(UnitVec3::of(Vec3(kInf, 0, 0)));
  EXPECT_FALSE(UnitVec3::of(Vec3(0, kNan, 1)));
}

TEST(UnitVec3, NamesTheAxesAndTurnsRound) {
  EXPECT_EQ(UnitVec3::x().vec(), Vec3::UnitX());
  EXPECT_EQ(UnitVec3::y().vec(), Vec3::UnitY());
  EXPECT_EQ((-UnitVec3::z()).vec(), -Vec3::UnitZ());
}

RC_GTEST_PROP(PoseLaws, APerpendicularIsAUnitVectorAtARightAngle, (std::uint64_t seed)) {
  const Vec3 axis = sample_pose(seed).rotation * Vec3::UnitX();
  const Vec3 across = perpendicular_to(axis);
  RC_ASSERT(std::abs(across.norm() - 1.0) < 4e-16);
  RC_ASSERT(std::abs(across.dot(axis)) < 4e-16);
}

}  // namespace
}  // namespace frustum
