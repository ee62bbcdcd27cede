// What a test does not see of its mounting, by hand.
#include <gtest/gtest.h>

#include "calibration/identify/measured_tests.hpp"
#include "core/units.hpp"
#include "instruments/rotary_test.hpp"
#include "instruments/sample_angles.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::calibration {
namespace {

// A bar of 100 mm along C does not see that its table ball is off across it, unless the axis is
// off, too. A C axis that is 10 um off centre moves the table by that on a circle; a ball that is
// 30 um off turns it into 30 um times 10 um over 100 mm: a cosine for one direction, a sine for
// the other.
TEST(UnseenMounting, IsTheProductOfBothOverTheLengthOfTheBar) {
  const auto machine = kinematics::shipped("zx-yac");
  instruments::RotaryTest rotary{.axis = kinematics::AxisLetter::C,
                                 .direction = instruments::BarDirection::axial,
                                 .table_ball = Vec3(60.0, 80.0, 40.0),
                                 .length = 100.0,
                                 .angles = instruments::midpoints(0.0, 360.0 * kRadPerDeg, 360)};
  const auto test = rotary_test(machine, rotary);
  ASSERT_TRUE(test.has_value());
  const std::vector<double> readings(test->poses.size(), 0.0);
  const BarRuns runs{{instruments::Sense::ccw, *test, readings}};
  const auto motion = measured_turn(machine, {"C", "", 0.0, 0.3e-3}, runs);
  ASSERT_TRUE(motion.has_value());
  const auto cause = trials::Parameter::named(machine, "EX0C");
  ASSERT_TRUE(cause.has_value());
  const std::vector<Unknown> unknowns{{.name = "EX0C"}};
  const std::vector<Cause> causes{{*cause, std::nullopt}};
  const auto covariance_at = [&](double offset) {
    return *unseen_mounting_covariance({*motion}, unknowns, causes,
                                       Eigen::VectorXd::Constant(1, offset));
  };
  const Eigen::MatrixXd covariance = covariance_at(0.01);
  // cos, sin, cos2, sin2: the mean is the mounting's own.
  ASSERT_EQ(covariance.rows(), 4);
  constexpr double kShown = 0.03 * 0.01 / 100.0;
  EXPECT_NEAR(covariance(0, 0) / (kShown * kShown), 1.0, 1e-2);
  EXPECT_NEAR(covariance(1, 1) / (kShown * kShown), 1.0, 1e-2);
  EXPECT_LT(std::abs(covariance(0, 1)), 1e-3 * kShown * kShown);
  EXPECT_LT(covariance(2, 2) + covariance(3, 3), 1e-3 * kShown * kShown);
  EXPECT_LT(covariance_at(0.0).norm(), 1e-6 * kShown * kShown);
}

}  // namespace
}  // namespace frustum::calibration
