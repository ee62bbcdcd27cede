#include "metrology/probing/ball_on_planes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "metrology/probing/ball_contact.hpp"

namespace frustum::metrology {
namespace {

const BallPath kFromAbove{Vec3(0.0, 0.0, 5.0), UnitVec3::z(), 1.5};

MaterialPlane plane(const Vec3& point, const Vec3& normal) { return {point, normal.normalized()}; }

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

// A ray shifted by -r m meets the solid at the last of its planes.
double travel_in(const Vec3& m, const BallPath& path, const std::vector<MaterialPlane>& planes) {
  double travel = -HUGE_VAL;
  for (const MaterialPlane& p : planes) {
    const Vec3 from = path.start - path.radius * m;
    travel = std::max(travel, (from - p.point).dot(p.normal) / path.outward.vec().dot(p.normal));
  }
  return travel;
}

TEST(BallOnPlanes, RestsOnOnePlane) {
  const Vec3 normal = Vec3(0.3, -0.2, 1.0).normalized();
  const auto rest = ball_on_planes(kFromAbove, std::vector{plane(Vec3(1.0, 2.0, 0.0), normal)});
  EXPECT_NEAR((rest.toward_centre - normal).norm(), 0.0, 1e-15);
  const Vec3 centre = kFromAbove.start - rest.travel * Vec3::UnitZ();
  EXPECT_NEAR((centre - Vec3(1.0, 2.0, 0.0)).dot(normal), 1.5, 1e-14);
}

TEST(BallOnPlanes, RestsOnTheEdgeOfTwo) {
  for (const double slope : {1e-5, 0.01, 1.0}) {
    // The ridge runs along y, beside the ball's way by less than it reaches.
    const double beside = 0.3 * slope;
    const std::vector ridge{plane(Vec3(beside, 0.0, 0.0), Vec3(slope, 0.0, 1.0)),
                            plane(Vec3(beside, 0.0, 0.0), Vec3(-slope, 0.0, 1.0))};
    const auto rest = ball_on_planes(kFromAbove, ridge);
    EXPECT_NEAR(rest.travel, 5.0 - std::sqrt(2.25 - beside * beside), 1e-14) << slope;
    EXPECT_NEAR((rest.toward_centre - Vec3(-beside / 1.5, 0.0, 0.0)).head<2>().norm(), 0.0, 1e-9);
  }
}

TEST(BallOnPlanes, RestsOnTheCornerOfThree) {
  for (const double slope : {1e-4, 0.01, 1.0}) {
    std::vector<MaterialPlane> pyramid;
    const Vec3 top(0.1 * slope, -0.2 * slope, 0.4);
    for (int i = 0; i < 3; ++i) {
      pyramid.push_back(
          plane(top, Vec3(slope * std::cos(2.1 * i), slope * std::sin(2.1 * i), 1.0)));
    }
    const auto rest = ball_on_planes(kFromAbove, pyramid);
    EXPECT_NEAR(rest.travel, 4.6 - std::sqrt(2.25 - 0.05 * slope * slope), 1e-13) << slope;
  }
}

TEST(BallOnPlanes, NoOtherDirectionGetsLessFar) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 300; ++i) {
    const double steep = std::pow(10.0, -0.015 * i);
    std::vector<MaterialPlane> planes;
    for (int k = 0; k < 1 + i % 6; ++k) {
      const Vec3 tilt(steep * normal(random), steep * normal(random), 1.0);
      planes.push_back(plane(0.3 * steep * steep * normal(random) * Vec3::UnitZ(), tilt));
    }
    // A plane met twice differs by rounding.
    planes.push_back(plane(planes[0].point, planes[0].normal + 1e-16 * Vec3(1.0, -2.0, 1.0)));
    const auto rest = ball_on_planes(kFromAbove, planes);
    EXPECT_NEAR(rest.toward_centre.norm(), 1.0, 1e-14);
    EXPECT_NEAR(travel_in(rest.toward_centre, kFromAbove, planes), rest.travel, 1e-13);
    for (int k = 0; k < 300; ++k) {
      const double step = steep * std::pow(10.0, -0.02 * k);
      const Vec3 aside(step * normal(random), step * normal(random), step * normal(random));
      const Vec3 m = (rest.toward_centre + aside).normalized();
      EXPECT_GE(travel_in(m, kFromAbove, planes), rest.travel - 1e-13) << i;
    }
  }
}

TEST(BallContact, FindsEdgesAndCornersWithFewRays) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  int most = 0;
  for (int i = 0; i < 400; ++i) {
    const double steep = std::pow(10.0, -0.012 * i);
    PlanesBody body;
    for (int k = 0; k < 2 + i % 5; ++k) {
      const Vec3 tilt(steep * normal(random), steep * normal(random), 1.0);
      body.planes.push_back(plane(0.2 * steep * steep * normal(random) * Vec3::UnitZ(), tilt));
    }
    const BallApproach approach{Vec3::Zero(), UnitVec3::z(), 1.5, 3.5, 10.0};
    const BallContact contact = touch_with_ball(body, approach);
    ASSERT_EQ(contact.state, ContactState::contact) << i;
    const auto rest = ball_on_planes(kFromAbove, body.planes);
    EXPECT_NEAR(contact.centre.z(), 5.0 - rest.travel, 1e-12) << i;
    most = std::max(most, body.rays);
  }
  EXPECT_LE(most, 20);
}

}  // namespace
}  // namespace frustum::metrology
