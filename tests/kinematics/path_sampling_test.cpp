#include "kinematics/path/path_sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace frustum::kinematics {
namespace {

double worst_distance(const std::function<ToolPose(double)>& motion,
                      const std::vector<ToolPose>& poses, double reach) {
  // Every point of the motion is within the bound of some segment at the same place on it.
  double worst = 0.0;
  for (int k = 0; k <= 1000; ++k) {
    const ToolPose exact = motion(k / 1000.0);
    double best = 1e300;
    for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
      const Vec3 step = poses[i + 1].tip - poses[i].tip;
      const double t =
          std::clamp((exact.tip - poses[i].tip).dot(step) / step.squaredNorm(), 0.0, 1.0);
      const ToolPose near = between(poses[i], poses[i + 1], t);
      best = std::min(best,
                      std::max((near.tip - exact.tip).norm(),
                               (near.tip - exact.tip + reach * (near.axis - exact.axis)).norm()));
    }
    worst = std::max(worst, best);
  }
  return worst;
}

TEST(PathSampling, KeepsTheBoundAtTipAndTopOfTheCutter) {
  const auto motion = [](double u) {
    const double phi = 0.6 * u + 0.2 * u * u;
    return ToolPose{40.0 * Vec3(std::cos(phi), std::sin(phi), 0.1 * phi + 1e-3 * std::cos(40 * u)),
                    Vec3(-0.7 * std::cos(phi), -0.7 * std::sin(phi), 0.5 + 0.1 * u).normalized()};
  };
  for (const double bound : {1e-3, 1e-5}) {
    std::vector<ToolPose> poses{motion(0.0)};
    for (const PathSample& s :
         sample_motion(motion, motion(0.0), {.bound = bound, .reach = 50.0})) {
      EXPECT_EQ(s.pose.tip, motion(s.u).tip);
      poses.push_back(s.pose);
    }
    EXPECT_LT(worst_distance(motion, poses, 50.0), bound);
    EXPECT_LT(poses.size(), bound == 1e-3 ? 400U : 4000U);
  }
}

TEST(PathSampling, LeavesAStraightMoveAlone) {
  const auto motion = [](double u) { return ToolPose{Vec3(100 * u, 20 * u, 0), Vec3::UnitZ()}; };
  EXPECT_EQ(sample_motion(motion, motion(0.0), {}).size(), 1U);
}

}  // namespace
}  // namespace frustum::kinematics
