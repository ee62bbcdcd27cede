#include "instruments/readings.hpp"

#include <cmath>

namespace frustum::instruments {
namespace {

Vec3 spindle_ball(const kinematics::ForwardChain& actual, const TestPose& pose,
                  const SetupErrors& setup) {
  return actual.table_from_tool(pose.at).point(setup.ball);
}

}  // namespace

Vec3 displacement(const kinematics::ForwardChain& actual, const TestPose& pose,
                  const SetupErrors& setup) {
  return spindle_ball(actual, pose, setup) - pose.spindle_ball - setup.table_ball;
}

std::vector<Vec3> displacements(const kinematics::ForwardChain& actual,
                                std::span<const TestPose> poses, const SetupErrors& setup) {
  std::vector<Vec3> d;
  d.reserve(poses.size());
  for (const TestPose& pose : poses) d.push_back(displacement(actual, pose, setup));
  return d;
}

std::vector<double> bar_readings(const kinematics::ForwardChain& actual, const MotionTest& test,
                                 const SetupErrors& setup, std::span<const Vec3> moved) {
  const Vec3 table_ball = test.table_ball + setup.table_ball;
  const double length = test.bar + setup.length;
  std::vector<double> readings;
  readings.reserve(test.poses.size());
  if (test.polynomials && moved.empty() && actual.locations_only()) {
    const auto from_table_ball =
        test.polynomials->at_all(3, [&](std::size_t i) -> Eigen::RowVectorXd {
          return (spindle_ball(actual, test.poses[i], setup) - table_ball).transpose();
        });
    if (from_table_ball) {
      const Eigen::VectorXd all = from_table_ball->rowwise().norm().array() - length;
      readings.assign(all.begin(), all.end());
      return readings;
    }
  }
  for (std::size_t i = 0; i < test.poses.size(); ++i) {
    Vec3 ball = spindle_ball(actual, test.poses[i], setup);
    if (!moved.empty()) ball += moved[i];
    readings.push_back((ball - table_ball).norm() - length);
  }
  return readings;
}

}  // namespace frustum::instruments
