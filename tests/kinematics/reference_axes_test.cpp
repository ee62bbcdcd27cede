#include "kinematics/errors/reference_axes.hpp"
#include "kinematics/errors/error_assignment.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/toml_document.hpp"
#include "kinematics/errors/error_table.hpp"
#include "kinematics/model/chain.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

// Orientation errors of every axis, whatever the machine's choice allows.
GeometricErrors oriented(const Machine& machine, std::mt19937& random) {
  std::uniform_real_distribution<double> angle(-50e-6, 50e-6), shift(-0.01, 0.01);
  GeometricErrors errors;
  for (const Joint& joint : machine.joints()) {
    for (std::size_t k = 0; k < 3; ++k) {
      errors[joint.letter].location[k] = shift(random);
      errors[joint.letter].location[k + 3] = angle(random);
    }
  }
  return errors;
}

AxisPositions somewhere(const Machine& machine, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  AxisPositions q;
  for (const Joint& joint : machine.joints()) {
    q[joint.letter] = joint.travel.lo + part(random) * joint.travel.width();
  }
  return q;
}

double pose_difference(const Pose& a, const Pose& b) {
  return std::max((a.translation - b.translation).norm(), 1e3 * (a.rotation - b.rotation).norm());
}

TEST(ReferenceAxesLaws, RestatingMovesTheToolByAConstantOnly) {
  // Second order: the product of two angles of 1e-4 over a lever of a metre, with margin.
  constexpr double kSecondOrder = 5e-5;
  for (const char* name : {"iwf-bc", "dvf5000", "zx-yac", "double-pivot-head"}) {
    const Machine machine = shipped(name);
    std::mt19937 random(5);
    const GeometricErrors before = oriented(machine, random);
    const auto after = restated(machine, before);
    ASSERT_TRUE(after) << name << ": " << after.error().front().message;
    const AxisLetter first = machine.datum()[0];
    const Vec3 tilt((*after)[first].location[3], (*after)[first].location[4],
                    (*after)[first].location[5]);
    EXPECT_LT(tilt.norm(), 1e-18) << name;
    const bool head = std::string(name) == "double-pivot-head";
    const auto constant = [&](const AxisPositions& q) {
      const Pose a = actual_pose(machine, before, q, 120.0);
      const Pose b = actual_pose(machine, *after, q, 120.0);
      return head ? b * a.inverse() : a.inverse() * b;  // of the workpiece, or of the tool
    };
    const Pose expected = constant(machine.home());
    double moved = 0.0;
    for (int k = 0; k < 40; ++k) {
      const AxisPositions q = somewhere(machine, random);
      EXPECT_LT(pose_difference(constant(q), expected), kSecondOrder) << name;
      moved = std::max(moved, pose_difference(constant(q), Pose{}));
    }
    EXPECT_GT(moved, 20 * kSecondOrder) << name;  // the constant itself is of first order
  }
}

TEST(ReferenceAxes, ErrorsOfAJobMayBeWrittenForOtherAxes) {
  const auto document = TomlDocument::parse(
      "[errors]\ndatum = [\"Y\", \"Z\"]\nEC0X = \"40 urad\"\nEA0Z = \"20 urad\"\n", "job.toml");
  ASSERT_TRUE(document);
  const ErrorList list = read_errors(document->root().table("errors"));
  ASSERT_FALSE(has_error(document->finish()));
  const Machine machine = shipped("iwf-bc");
  const auto errors = resolve(machine, list.entries);
  ASSERT_TRUE(errors) << errors.error().front().message;
  // X is the primary axis of the machine: that X is not perpendicular to Y by 40 urad now is Y's to
  // bear.
  EXPECT_NEAR((*errors)[AxisLetter::X].location[5], 0.0, 1e-18);
  EXPECT_NEAR((*errors)[AxisLetter::Y].location[5], -40e-6, 1e-18);
  EXPECT_NEAR((*errors)[AxisLetter::Z].location[3], 20e-6, 1e-18);
  EXPECT_NEAR((*errors)[AxisLetter::B].location[5], -40e-6, 1e-18);
}

TEST(ReferenceAxes, SayWhatCannotBeRestated) {
  const Machine machine = shipped("zx-yac");
  GeometricErrors carried;
  carried[AxisLetter::Z].carried_tilt = Vec3(1e-5, 0, 0);
  const auto refused = restated(machine, carried);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().front().message,
            "the errors cannot be stated for other reference axes: a tilt of Z also turns what it "
            "carries");
  const auto without = restated(shipped("three-axis"), {});
  EXPECT_EQ(without.has_value(), shipped("three-axis").datum().size() == 2);
}

}  // namespace
}  // namespace frustum::kinematics
