// The vectors by which a control corrects its kinematics, against the chain.
#include "kinematics/errors/axis_vectors.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/random.hpp"
#include "kinematics/model/chain.hpp"
#include "kinematics/model/inverse.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

GeometricErrors random_locations(std::uint32_t draw) {
  GeometricErrors errors;
  std::uint64_t next = 0;
  for (const AxisLetter letter : kAxisLetters) {
    for (std::size_t k = 0; k < 6; ++k) {
      const double size = k < 3 ? 20e-3 : 60e-6;
      errors[letter].location.at(k) = size * normal({.seed = 3, .draw = draw}, next++);
    }
  }
  return errors;
}

Pose turned_about(const AxisLineVectors& line, double angle) {
  const Mat3 r = Eigen::AngleAxisd(angle, line.direction).toRotationMatrix();
  return {r, line.point - r * line.point};
}

// A table that turns about these lines is where the actual one is, and so is a head.
TEST(AxisVectorsLaws, TurnAsTheActualMachineDoes) {
  for (const char* name : {"zx-yac", "iwf-bc", "swivel-head-table", "double-pivot-head"}) {
    const Machine machine = shipped(name);
    for (std::uint32_t draw = 0; draw < 20; ++draw) {
      const GeometricErrors errors = random_locations(draw);
      const ForwardChain actual(machine, errors, 0.0);
      const auto vectors = axis_vectors(machine, errors);
      AxisPositions q;
      for (const AxisLetter letter : kRotaryAxes) {
        if (machine.joint(letter) != nullptr) {
          q[letter] = normal({.seed = 4, .draw = draw}, static_cast<std::uint64_t>(letter));
        }
      }
      Pose table, tool;
      for (const AxisVectors& each : vectors) {
        Pose& side = each.side < 0 ? table : tool;
        side = side * turned_about(each.in_bed, each.side * q[each.axis]);
      }
      const Pose expected_table = table * actual.bed_from_table(AxisPositions{});
      const Pose expected_tool = tool * actual.bed_from_tool(AxisPositions{});
      EXPECT_LT((expected_table.translation - actual.bed_from_table(q).translation).norm(), 1e-9);
      EXPECT_LT((expected_table.rotation - actual.bed_from_table(q).rotation).norm(), 1e-12);
      EXPECT_LT((expected_tool.translation - actual.bed_from_tool(q).translation).norm(), 1e-9);
      EXPECT_LT((expected_tool.rotation - actual.bed_from_tool(q).rotation).norm(), 1e-12);
    }
  }
}

// At the machine coordinates of a table axis the gauge point is on it.
TEST(AxisVectors, TheGaugePointMeetsTheAxisOfATable) {
  const Machine machine = shipped("zx-yac");
  for (const AxisVectors& each : axis_vectors(machine, {})) {
    ASSERT_EQ(each.side, -1);
    AxisPositions q;
    for (const AxisLetter letter : kLinearAxes) {
      q[letter] = each.nominal.point[static_cast<Eigen::Index>(letter)];
    }
    // Turning the axis by half a turn leaves a point of it where it was.
    AxisPositions turned = q;
    turned[each.axis] = 1.0;
    EXPECT_LT(
        (nominal_pose(machine, q, 0.0).translation - nominal_pose(machine, turned, 0.0).translation)
            .norm(),
        1e-9)
        << to_char(each.axis);
  }
}

// Signs, by errors of known effect.
TEST(AxisVectors, ErrorsMoveTheAxisAsTheirNamesSay) {
  const Machine machine = shipped("zx-yac");
  GeometricErrors errors;
  errors[AxisLetter::C].location = {10e-3, 0, 0, 0, 30e-6, 0};
  const auto nominal = axis_vectors(machine, {}), actual = axis_vectors(machine, errors);
  for (std::size_t k = 0; k < actual.size(); ++k) {
    if (actual[k].axis != AxisLetter::C) continue;
    EXPECT_NEAR(actual[k].in_bed.direction.x() - nominal[k].in_bed.direction.x(), 30e-6, 1e-12);
    EXPECT_NEAR(actual[k].actual.point.x() - nominal[k].nominal.point.x(), 10e-3, 1e-8);
  }
}

}  // namespace
}  // namespace frustum::kinematics
