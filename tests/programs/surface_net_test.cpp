#include "programs/surface/surface_net.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "programs/milling/point_milling.hpp"

namespace frustum::programs {
namespace {

TEST(SurfaceNet, ReadsRowsInOrder) {
  const auto net =
      parse_surface_net("row,x,y,z\n0,0,0,0\n0,10,0,1\n0,20,0,0\n1,0,9,0\n1,10,9,2\n1,20,9,0\n");
  ASSERT_TRUE(net) << to_string(net.error().front());
  EXPECT_EQ(net->rows(), 2u);
  EXPECT_EQ(net->columns(), 3u);
  EXPECT_EQ(net->net()[4], Vec3(10, 9, 2));
}

TEST(SurfaceNet, SaysWhatIsWrongAndWhere) {
  const auto fault = [](const std::string& text) {
    const auto net = parse_surface_net("row,x,y,z\n" + text, "n.csv");
    return net ? std::string() : to_string(net.error().front());
  };
  EXPECT_TRUE(fault("1,0,0,0\n").starts_with("n.csv:2:1: error: row 1 follows row none"));
  EXPECT_TRUE(fault("0,0,0,0\n0,1,0,0\n1,0,1,0\n").starts_with("n.csv:4:1: error: row 1 has 1"));
  EXPECT_TRUE(fault("0,0,0,0\n0,1,0,0\n1,0,1,0\n1,1,1,0\n1,2,1,0\n2,0,2,0\n")
                  .starts_with("n.csv:7:1: error: row 1 has 3 points, row 0 has 2"));
  EXPECT_TRUE(fault("0,0,0,x\n").starts_with("n.csv:2:7: error: z 'x' is no finite number"));
  EXPECT_TRUE(fault("0,0,0,0\n").starts_with("n.csv: error: a net has two rows or more"));
}

SplineSurface bowl(double depth) {
  std::vector<Vec3> net;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      // Rows run along -x, so that normals point up.
      const double x = 30.0 - 15.0 * j, y = 15.0 * i - 30.0;
      net.emplace_back(x, y, depth * (x * x + y * y) / 900.0);
    }
  }
  return {net, 5};
}

TEST(PointMilling, TheBallTouchesTheSurfaceAtItsPoint) {
  const SplineSurface surface = bowl(4.0);
  EXPECT_GT(surface.at(0.5, 0.5).normal().z(), 0.9);
  const BallCutter cutter{3.0, 0.3};
  for (const double u : {-0.05, 0.2, 0.7}) {
    for (const double v : {0.0, 0.5, 1.0}) {
      const auto pose = ball_pose(surface, cutter, u, v);
      const Vec3 centre = pose.tip + cutter.radius * pose.axis;
      EXPECT_NEAR(surface.nearest(centre).distance, cutter.radius, 1e-9);
      EXPECT_NEAR(pose.axis.norm(), 1.0, 1e-12);
      EXPECT_NEAR(pose.axis.dot(surface.at(u, v).normal()), std::cos(0.3), 1e-12);
    }
  }
}

TEST(PointMilling, RefusesABallThatDoesNotFit) {
  const SplineSurface surface = bowl(4.0);
  EXPECT_FALSE(does_not_fit(surface, BallCutter{20.0, 0.0}));
  EXPECT_TRUE(does_not_fit(surface, BallCutter{200.0, 0.0}));
  EXPECT_FALSE(does_not_fit(bowl(-4.0), BallCutter{200.0, 0.0}));
}

}  // namespace
}  // namespace frustum::programs
