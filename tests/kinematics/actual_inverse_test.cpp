#include "kinematics/model/actual_inverse.hpp"
#include "kinematics/errors/error_assignment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.hpp"
#include "kinematics/model/chain.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

constexpr double kToolLength = 120.0;

double drawn(std::uint64_t index, double size) {
  return size * (2.0 * uniform({.seed = 4031}, index) - 1.0);
}

// Every error the machine accepts: 20 um or 50 urad, half of them over the axis's travel.
GeometricErrors large_errors(const Machine& machine) {
  std::vector<ErrorEntry> entries;
  std::uint64_t k = 0;
  for (const ErrorName& name : machine.error_names()) {
    ++k;
    std::string text = name.text() + '=';
    if (!name.location && k % 2 == 0) text += "linear ";
    text += is_rotation(name.direction) ? "50 urad" : "20 um";
    entries.push_back(*parse_error(text));
  }
  return *resolve(machine, entries);
}

class ActualInverseOfMachine : public ::testing::TestWithParam<const char*> {};

TEST_P(ActualInverseOfMachine, BringsTheActualToolToTheWantedPoseAwayFromThePole) {
  const Machine machine = shipped(GetParam());
  const GeometricErrors errors = large_errors(machine);
  double worst_tip = 0.0, worst_axis = 0.0;
  for (std::uint64_t k = 0; k < 500; ++k) {
    AxisPositions q;
    for (std::size_t i = 0; i < 6; ++i) {
      if (machine.joint(kAxisLetters[i]) == nullptr) continue;
      const double size = i < 3 ? 150.0 : (kAxisLetters[i] == AxisLetter::C ? 3.0 : 1.2);
      q[kAxisLetters[i]] = drawn(6 * k + i, size);
    }
    if (std::hypot(q[AxisLetter::A], q[AxisLetter::B]) < 0.3) continue;
    const ToolPose wanted = tool_pose(nominal_pose(machine, q, kToolLength));
    const AxisPositions found = actual_inverse(machine, errors, wanted, kToolLength, q);
    const ToolPose reached = tool_pose(actual_pose(machine, errors, found, kToolLength));
    worst_tip = std::max(worst_tip, (reached.tip - wanted.tip).norm());
    worst_axis = std::max(worst_axis, angle_between(reached.axis, wanted.axis));
  }
  EXPECT_LT(worst_tip, 1e-9);
  // The stiffness leaves (1e-3 / sin 17 deg)^2 of some 150 urad.
  EXPECT_LT(worst_axis, 5e-9);
}

INSTANTIATE_TEST_SUITE_P(FiveAxes, ActualInverseOfMachine,
                         ::testing::Values("zx-yac", "iwf-bc", "dvf5000", "double-pivot-head",
                                           "swivel-head-table"));

TEST(ActualInverse, KeepsTheTipExactAndTheTableStillAtThePole) {
  const Machine machine = shipped("iwf-bc");
  const GeometricErrors errors = large_errors(machine);
  for (const double tilt : {0.0, 1e-9, 1e-6, 1e-4, 1e-2}) {
    AxisPositions q;
    q[AxisLetter::B] = tilt;
    q[AxisLetter::C] = 0.4;
    const ToolPose wanted = tool_pose(nominal_pose(machine, q, kToolLength));
    const AxisPositions found = actual_inverse(machine, errors, wanted, kToolLength, q);
    const ToolPose reached = tool_pose(actual_pose(machine, errors, found, kToolLength));
    EXPECT_LT((reached.tip - wanted.tip).norm(), 1e-9) << tilt;
    EXPECT_LT(std::abs(found[AxisLetter::C] - q[AxisLetter::C]), 0.2) << tilt;
    EXPECT_LT(angle_between(reached.axis, wanted.axis), 5e-4) << tilt;
  }
}

TEST(ActualInverse, LeavesTheDirectionOfAThreeAxisMachineAndMeetsTheTip) {
  const Machine machine = shipped("three-axis");
  const GeometricErrors errors = large_errors(machine);
  AxisPositions q;
  q[AxisLetter::X] = 80.0;
  q[AxisLetter::Y] = -60.0;
  q[AxisLetter::Z] = 200.0;
  const ToolPose wanted = tool_pose(nominal_pose(machine, q, kToolLength));
  const AxisPositions found = actual_inverse(machine, errors, wanted, kToolLength, q);
  EXPECT_LT((tool_pose(actual_pose(machine, errors, found, kToolLength)).tip - wanted.tip).norm(),
            1e-9);
}

TEST(ActualInverse, IsTheNominalPositionWithoutErrors) {
  const Machine machine = shipped("zx-yac");
  AxisPositions q;
  q[AxisLetter::X] = 12.0;
  q[AxisLetter::A] = -0.7;
  q[AxisLetter::C] = 2.0;
  const ToolPose wanted = tool_pose(nominal_pose(machine, q, kToolLength));
  const AxisPositions found = actual_inverse(machine, {}, wanted, kToolLength, q);
  for (const AxisLetter letter : kAxisLetters) EXPECT_NEAR(found[letter], q[letter], 1e-12);
}

}  // namespace
}  // namespace frustum::kinematics
