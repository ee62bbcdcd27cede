#include <gtest/gtest.h>

#include <algorithm>

#include "kinematics/errors/error_assignment.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "kinematics/model/chain.hpp"
#include "tests/kinematics/machines.hpp"
#include "tests/kinematics/random_machine.hpp"

namespace frustum::kinematics {
namespace {

// `amount` of one error, through the names and units of its text.
GeometricErrors only(const Machine& machine, const MachineError& error, double amount) {
  const std::string text = fmt::format("{}={:.17g}{}", error.name, amount,
                                       is_rotation(error.error.direction) ? "rad" : "mm");
  return *resolve(machine, std::vector{*parse_error(text)});
}

Vec3 rotation_vector(const Mat3& r) {
  return 0.5 * Vec3(r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1));
}

using SixVector = Eigen::Matrix<double, 6, 1>;

// Central difference of one of the poses of the exact chain: of `point` in the pose's moving frame.
SixVector error_difference(const Machine& machine, const MachineError& error,
                           const AxisPositions& q,
                           Pose (ForwardChain::*pose)(const AxisState&) const, double tool_length,
                           const Vec3& point) {
  // Rotations: 1e-4 rad leaves 2e-9 of third order and 1e-9 of rounding; translations are linear.
  const double h = is_rotation(error.error.direction) ? 1e-4 : 1e-1;
  const GeometricErrors plus = only(machine, error, h), minus = only(machine, error, -h);
  const Pose up = (ForwardChain(machine, plus, tool_length).*pose)(q);
  const Pose down = (ForwardChain(machine, minus, tool_length).*pose)(q);
  SixVector d;
  d << (up.point(point) - down.point(point)) / (2.0 * h),
      rotation_vector(up.rotation * down.rotation.transpose()) / (2.0 * h);
  return d;
}

void expect_close(const SixVector& analytic, const SixVector& numeric, const std::string& what) {
  // 1e-6 relative; the absolute parts are the rounding of metres over the step.
  const double tip = numeric.head<3>().norm(), turn = numeric.tail<3>().norm();
  EXPECT_LT((analytic - numeric).head<3>().norm(), 1e-6 * tip + 1e-8) << what;
  EXPECT_LT((analytic - numeric).tail<3>().norm(), 1e-6 * turn + 1e-11) << what;
}

void expect_gains_are_differences(const Machine& machine, const AxisPositions& q) {
  constexpr double kToolLength = 120.0;
  std::vector<MachineError> errors = every_error(machine);
  std::vector<std::string> aliases;
  for (const auto& [name, alias] : machine.aliases()) aliases.push_back(name);
  const auto named = errors_named(machine, aliases);
  ASSERT_TRUE(named);
  errors.insert(errors.end(), named->begin(), named->end());
  const Vec3 from_tip(3, -40, 77), on_table(-50, 160, 30);
  const GainMatrix both = gain_matrix(machine, errors, q, kToolLength);
  const GainMatrix tool = tool_side_gain(machine, errors, q, kToolLength, from_tip);
  const GainMatrix work = work_side_gain(machine, errors, q, on_table);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const auto numeric = [&](auto pose, const Vec3& point) {
      return error_difference(machine, errors[i], q, pose, kToolLength, point);
    };
    const std::string what = machine.structure() + " " + errors[i].name;
    expect_close(both.col(column), numeric(&ForwardChain::table_from_tool, Vec3::Zero()), what);
    expect_close(tool.col(column), numeric(&ForwardChain::bed_from_tool, from_tip), what);
    expect_close(work.col(column), numeric(&ForwardChain::bed_from_table, on_table), what);
  }
}

TEST(GainMatrixLaws, EqualsFiniteDifferencesOn30RandomStructureCodes) {
  for (std::uint32_t k = 0; k < 30; ++k) {
    RandomMachine random(k);
    const Machine machine = machine_of(random.text());
    for (int i = 0; i < 3; ++i) expect_gains_are_differences(machine, random.position());
  }
}

TEST(GainMatrixLaws, EqualsFiniteDifferencesForAliasesThatCarry) {
  RandomMachine random(99);
  for (const char* name : {"zx-yac", "dvf5000"}) {
    expect_gains_are_differences(shipped(name), random.position());
  }
}

TEST(GainMatrix, SumsToTheFirstOrderDisplacementOfAllErrorsTogether) {
  RandomMachine random(7);
  const Machine machine = machine_of(random.text());
  const std::vector<MachineError> errors = every_error(machine);
  const AxisPositions q = random.position();
  Eigen::VectorXd amounts(static_cast<Eigen::Index>(errors.size()));
  GeometricErrors all;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double amount = random.signed_draw(1e-3);
    amounts[static_cast<Eigen::Index>(i)] = amount;
    all = all.plus(only(machine, errors[i], amount), 1.0);
  }
  const SixVector sum = gain_matrix(machine, errors, q, 100.0) * amounts;
  const PoseDisplacement together = first_order_displacement(machine, all, q, 100.0);
  EXPECT_LT((sum.head<3>() - together.tip).norm(), 1e-11);
  EXPECT_LT((sum.tail<3>() - together.turn).norm(), 1e-14);
}

TEST(GainMatrix, RefusesNamesThatTheMachineDoesNotKnow) {
  const std::vector<std::string> names = {"EXX", "EXA", "aYX", "EA0X"};
  const auto found = errors_named(shipped("dvf5000"), names);
  ASSERT_FALSE(found);
  ASSERT_EQ(found.error().size(), 3U);
  EXPECT_EQ(found.error()[0].message,
            "error EXA: machine dvf5000 (t-(C)-Z-Y-X-b-B-C-w) has no axis A");
  EXPECT_EQ(found.error()[1].message, "unknown error name 'aYX' for machine dvf5000");
}

}  // namespace
}  // namespace frustum::kinematics
