#include "metrology/probing/ball_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace frustum::metrology {
namespace {

struct MaterialPlane {
  Vec3 point, normal;
};

MaterialPlane plane(const Vec3& point, const Vec3& normal) { return {point, normal.normalized()}; }

BallContact touch_from_above(const SurfaceProbeRef& part, double x, double y) {
  return touch_with_ball(part, {Vec3(x, y, 0.0), UnitVec3::z(), 1.5, 3.5, 10.0});
}

// The solid that planes bound together, met exactly; counts the rays that it is asked.
struct PlanesBody {
  std::vector<MaterialPlane> planes;
  mutable int rays = 0;

  [[nodiscard]] std::optional<Touch> touch(const Vec3& start, const UnitVec3& direction,
                                           double length_mm) const {
    ++rays;
    double far = -HUGE_VAL;
    Vec3 normal = Vec3::Zero();
    for (const MaterialPlane& p : planes) {
      const double s = (p.point - start).dot(p.normal) / direction.vec().dot(p.normal);
      if (s > far) {
        far = s;
        normal = p.normal;
      }
    }
    if (far < 0.0 || far > length_mm) return std::nullopt;
    return Touch{start + far * direction.vec(), normal};
  }
};

// Two hollow faces of one radius with their common ridge along y, for rays against z.
struct HollowRidge {
  double radius, tilt;
  mutable int rays = 0;

  [[nodiscard]] std::optional<Touch> touch(const Vec3& start, const UnitVec3& /*down*/,
                                           double /*length_mm*/) const {
    ++rays;
    const double side = start.x() > 0.0 ? 1.0 : -1.0;
    const Vec3 middle(side * radius * std::sin(tilt), 0.0, radius * std::cos(tilt));
    const double x = start.x() - middle.x();
    const Vec3 point(start.x(), start.y(), middle.z() - std::sqrt(radius * radius - x * x));
    return Touch{point, Vec3(middle.x() - point.x(), 0.0, middle.z() - point.z()).normalized()};
  }
};

TEST(BallContact, FindsRidgesOfFlatFacesWithFewRays) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.05, 0.95), turn(0.0, 6.2);
  for (int i = 0; i < 400; ++i) {
    const double left = std::pow(10.0, -0.01 * i), right = 0.7 * left, along = turn(random);
    const Vec3 across(std::cos(along), std::sin(along), 0.0);
    PlanesBody body;
    body.planes.push_back(
        plane(Vec3::Zero(), std::cos(left) * Vec3::UnitZ() - std::sin(left) * across));
    body.planes.push_back(
        plane(Vec3::Zero(), std::cos(right) * Vec3::UnitZ() + std::sin(right) * across));
    // The ball's lowest direction is between both normals.
    const double lean = -left + share(random) * (left + right);
    const Vec3 beside = 1.5 * std::sin(lean) * across;
    const BallContact contact = touch_from_above(body, beside.x(), beside.y());
    ASSERT_EQ(contact.state, ContactState::contact) << i;
    EXPECT_NEAR(contact.centre.z(), 1.5 * std::cos(lean), 1e-9) << i;
    EXPECT_NEAR((contact.touch.normal - contact.centre / 1.5).norm(), 0.0, 2e-5) << i;
    EXPECT_LE(body.rays, 10) << i;
  }
}

TEST(BallContact, NeverPassesACornerByMoreThanItsEdgesLeaveOpen) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 400; ++i) {
    const double steep = std::pow(10.0, -0.01 * i);
    PlanesBody body;
    for (int k = 0; k < 3; ++k) {
      const double around = 2.1 * k + 0.1 * normal(random);
      body.planes.push_back(
          plane(Vec3::Zero(), Vec3(steep * std::cos(around), steep * std::sin(around), 1.0)));
    }
    const BallContact contact =
        touch_from_above(body, 0.1 * steep * normal(random), 0.1 * steep * normal(random));
    ASSERT_EQ(contact.state, ContactState::contact) << i;
    const double exact = std::sqrt(2.25 - contact.centre.head<2>().squaredNorm());
    EXPECT_LE(contact.centre.z(), exact + 1e-12) << i;
    EXPECT_GE(contact.centre.z(), exact - 0.5 * steep * steep) << i;
  }
}

TEST(BallContact, FindsRidgesOfHollowFaces) {
  for (const double tilt : {1e-3, 0.01, 0.1, 0.7}) {
    for (const double share : {-0.9, -0.4, 0.1, 0.5, 0.95}) {
      const HollowRidge ridge{.radius = 30.0, .tilt = tilt};
      const double beside = share * 1.5 * std::sin(tilt);
      const BallContact contact = touch_from_above(ridge, beside, 0.0);
      ASSERT_EQ(contact.state, ContactState::contact);
      EXPECT_NEAR(contact.centre.z(), std::sqrt(2.25 - beside * beside), 1e-9)
          << tilt << ", " << share;
      EXPECT_NEAR(contact.touch.normal.x(), beside / 1.5, 1e-6) << tilt << ", " << share;
      EXPECT_LE(ridge.rays, tilt < 0.5 ? 30 : 90) << tilt << ", " << share;
    }
  }
}

}  // namespace
}  // namespace frustum::metrology
