#include "dynamics/rigid_body.hpp"

#include <gtest/gtest.h>

#include "tests/dynamics/machines.hpp"

namespace frustum::dynamics {
namespace {

json tensor_of(const RigidBody& body) {
  const Mat3& i = body.inertia;
  return {i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)};
}

TEST(RigidBodyReference, SumsABoxAndACylinder) {
  const Solid box{.shape = SolidBox{Vec3(1.0, 0.4, 0.2)}, .mass = 7200.0 * 0.08};
  Solid cylinder{.shape = SolidCylinder{0.3, 0.5}};
  cylinder.mass = 7850.0 * volume_of(cylinder.shape);
  cylinder.at = Vec3(0.2, 0.1, 0.35);
  const RigidBody body = body_of(std::vector{box, cylinder});
  const json& wanted = expected()["closed_forms"]["composite_body"];
  EXPECT_NEAR(body.mass, wanted["mass_kg"].get<double>(), 1e-6);
  expect_near(as_json(Vec3(body.centre * 1e3)), wanted["com_mm"], 1e-9, "centre");
  expect_near(tensor_of(body), wanted["inertia_xx_yy_zz_xy_xz_yz"], 1e-9, "tensor");
}

TEST(RigidBody, APrismWithARectangleIsABoxEitherWayRound) {
  std::vector<Eigen::Vector2d> outline{{0.1, 0.2}, {0.9, 0.2}, {0.9, 0.5}, {0.1, 0.5}};
  const Solid box{.shape = SolidBox{Vec3(0.8, 0.3, 0.7)}, .mass = 3.0, .at = Vec3(0.5, 0.35, 0.0)};
  const RigidBody wanted = body_of(std::vector{box});
  for (int way = 0; way < 2; ++way) {
    const Solid prism{.shape = SolidPrism{outline, 0.7}, .mass = 3.0};
    EXPECT_NEAR(volume_of(prism.shape), 0.8 * 0.3 * 0.7, 1e-15);
    const RigidBody body = body_of(std::vector{prism});
    EXPECT_LT((body.centre - wanted.centre).norm(), 1e-15);
    EXPECT_LT((body.inertia - wanted.inertia).norm(), 1e-14);
    std::ranges::reverse(outline);
  }
}

TEST(RigidBody, PartsOfABoxMakeTheBox) {
  const Mat3 turned = rotation_z(0.3) * rotation_y(-0.8) * rotation_x(1.1);
  std::vector<Solid> halves;
  for (const double side : {-1.0, 1.0}) {
    halves.push_back(
        {SolidBox{Vec3(0.5, 0.4, 0.2)}, 2.0, turned * Vec3(0.25 * side, 0, 0), turned});
  }
  const Solid whole{SolidBox{Vec3(1.0, 0.4, 0.2)}, 4.0, Vec3::Zero(), turned};
  const RigidBody body = body_of(halves), wanted = body_of(std::vector{whole});
  EXPECT_NEAR(body.mass, 4.0, 1e-15);
  EXPECT_LT((body.inertia - wanted.inertia).norm(), 1e-15);
}

TEST(RigidBody, RefusesTensorsOfNoBody) {
  EXPECT_FALSE(impossible_inertia(Mat3(Vec3(1, 2, 3).asDiagonal())));  // a plate
  EXPECT_TRUE(impossible_inertia(Mat3(Vec3(1, 2, 3.01).asDiagonal())));
  EXPECT_TRUE(impossible_inertia(Mat3(Vec3(0, 2, 2).asDiagonal())));
  Mat3 product = Mat3(Vec3(2, 2, 3).asDiagonal());
  product(0, 1) = product(1, 0) = 2.1;
  EXPECT_TRUE(impossible_inertia(product));
  EXPECT_FALSE(impossible_inertia(Mat3(Vec3(1e-6, 1, 1).asDiagonal())));  // a thin rod
  EXPECT_TRUE(impossible_inertia(Mat3(Vec3(1e-12, 1, 1).asDiagonal())));
}

TEST(RigidBody, TellsAnOutlineThatCrossesItself) {
  const auto crosses = [](std::vector<Eigen::Vector2d> outline) {
    return crosses_itself({std::move(outline), 1.0});
  };
  EXPECT_FALSE(crosses({{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_FALSE(crosses({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 3}, {0, 3}}));  // an L
  EXPECT_TRUE(crosses({{0, 0}, {3, 0}, {0, 1}, {2, 1}}));                   // a bow tie
  EXPECT_TRUE(crosses({{0, 0}, {2, 0}, {2, 2}, {1, -1}, {0, 2}}));
}

}  // namespace
}  // namespace frustum::dynamics
