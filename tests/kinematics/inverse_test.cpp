#include "kinematics/inverse.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "kinematics/chain.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

AxisPositions random_position(const Machine& machine, std::uint32_t draw) {
  AxisPositions q;
  std::uint64_t index = 0;
  for (const Joint& joint : machine.joints()) {
    const double u = uniform({.seed = 7, .draw = draw}, index++);
    q[joint.letter] = joint.travel.lo + u * joint.travel.width();
  }
  return q;
}

class EveryMachine : public testing::TestWithParam<const char*> {};

TEST_P(EveryMachine, ReturnsToTheSamePoseAfterInverseAndForwardKinematics) {
  const Machine machine = shipped(GetParam());
  double worst_tip = 0.0, worst_axis = 0.0;
  for (std::uint32_t draw = 0; draw < 10000; ++draw) {
    const AxisPositions q = random_position(machine, draw);
    const double length = 200.0 * uniform({.seed = 8, .draw = draw}, 0);
    const ToolPose pose = tool_pose(nominal_pose(machine, q, length));
    const auto solutions = inverse(machine, pose, length, q);
    ASSERT_TRUE(solutions) << to_string(solutions.error().front());
    ASSERT_TRUE(solutions->front().within_travel);
    for (const InverseSolution& solution : *solutions) {
      const ToolPose back = tool_pose(nominal_pose(machine, solution.axes, length));
      worst_tip = std::max(worst_tip, (back.tip - pose.tip).norm());
      worst_axis = std::max(worst_axis, (back.axis - pose.axis).norm());
    }
  }
  EXPECT_LT(worst_tip, 1e-9);
  EXPECT_LT(worst_axis, 1e-12);
  RecordProperty("worst_tip_mm", std::to_string(worst_tip * 1e12) + "e-12");
  RecordProperty("worst_axis_rad", std::to_string(worst_axis * 1e15) + "e-15");
}

TEST_P(EveryMachine, KeepsThePreviousSolutionAlongASmoothMotion) {
  const Machine machine = shipped(GetParam());
  const AxisPositions start = random_position(machine, 1), end = random_position(machine, 2);
  AxisPositions q = start;
  for (int i = 0; i <= 2000; ++i) {
    AxisPositions wanted;
    for (const AxisLetter letter : kAxisLetters) {
      wanted[letter] = start[letter] + i / 2000.0 * (end[letter] - start[letter]);
    }
    const auto solutions =
        inverse(machine, tool_pose(nominal_pose(machine, wanted, 100.0)), 100.0, q);
    ASSERT_TRUE(solutions);
    q = solutions->front().axes;
    for (const AxisLetter letter : kAxisLetters) ASSERT_NEAR(q[letter], wanted[letter], 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(Shipped, EveryMachine,
                         testing::Values("zx-yac", "iwf-bc", "dvf5000", "double-pivot-head",
                                         "swivel-head-table", "three-axis"));

TEST(Inverse, ReportsTheSingularDirectionAndKeepsTheFreeAxis) {
  const Machine machine = shipped("iwf-bc");
  AxisPositions previous;
  previous[AxisLetter::C] = 1.25;
  const auto solutions = inverse(machine, {Vec3(10, 20, 30), Vec3::UnitZ()}, 0.0, previous);
  ASSERT_TRUE(solutions);
  EXPECT_TRUE(solutions->front().singular);
  EXPECT_DOUBLE_EQ(solutions->front().axes[AxisLetter::C], 1.25);
}

TEST(Inverse, IsExactBesideThePole) {
  const Machine machine = shipped("iwf-bc");
  for (const double tilt : {1e-3, 1e-5, 1e-7, 1e-9}) {
    const Vec3 axis = rotation_z(0.7) * rotation_y(tilt) * Vec3::UnitZ();
    const auto solutions = inverse(machine, {Vec3(10, 20, 30), axis}, 50.0, {});
    ASSERT_TRUE(solutions);
    for (const InverseSolution& s : *solutions) {
      EXPECT_LT((tool_pose(nominal_pose(machine, s.axes, 50.0)).axis - axis).norm(), 1e-12) << tilt;
    }
  }
}

TEST(Inverse, SaysByHowMuchADirectionIsOutOfReach) {
  const Machine machine = shipped("three-axis");
  const auto tilted = inverse(machine, {Vec3::Zero(), rotation_x(0.1) * Vec3::UnitZ()}, 0.0, {});
  ASSERT_FALSE(tilted);
  EXPECT_NE(tilted.error().front().message.find("5.729578 deg off the spindle"), std::string::npos);
}

TEST(Inverse, PrefersTheSolutionWithinTravel) {
  const Machine machine = shipped("iwf-bc");
  // 100 deg of tilt: B = -100 and B = +100 are both in reach; 115 deg is not.
  const auto out =
      inverse(machine, {Vec3(0, 0, 100), rotation_y(115.0 * kRadPerDeg) * Vec3::UnitZ()}, 0.0, {});
  ASSERT_TRUE(out);
  EXPECT_FALSE(out->front().within_travel);
  EXPECT_FALSE(travel_violations(machine, out->front().axes).empty());
}

}  // namespace
}  // namespace frustum::kinematics
