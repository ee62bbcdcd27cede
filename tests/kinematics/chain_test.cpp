#include "kinematics/model/chain.hpp"
#include "kinematics/errors/error_assignment.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinematics/model/inverse.hpp"
#include "tests/kinematics/machines.hpp"
#include "tests/kinematics/random_machine.hpp"

namespace frustum::kinematics {
namespace {

using enum parser::AxisLetter;

GeometricErrors errors(const Machine& machine, const std::vector<std::string>& texts) {
  std::vector<ErrorEntry> entries;
  for (const std::string& text : texts) entries.push_back(*parse_error(text));
  auto resolved = resolve(machine, entries);
  EXPECT_TRUE(resolved) << (resolved ? "" : to_string(resolved.error().front()));
  return *resolved;
}

double difference(const Pose& a, const Pose& b) {
  return std::max((a.translation - b.translation).norm(), 100.0 * (a.rotation - b.rotation).norm());
}

TEST(ChainReference, ReproducesTheTableTrajectoryOfBossoniEquation330) {
  const Machine machine = shipped("iwf-bc");
  // Samples of expected/cone-test.json: phi, X, Y, Z (mm), B, C (deg); alpha 45, beta 30, r 40.
  constexpr double kSamples[][6] = {{0, 4.3219493040505625, 0, 133.4278406275622, -15, 0},
                                    {30, 54.500133749986894, 40.24922359499621, 120.99001197837327,
                                     -23.28373172110511, 63.434948822922},
                                    {60, 116.14547392736476, 44.86598213592776, 87.00923217295336,
                                     -37.893932584052834, 94.4230368942755},
                                    {90, 158.29529767543877, 40.24922359499621, 40.59062371834449,
                                     -52.23875609296496, 116.56505117707799},
                                    {180, 189.99638312248604, 0, -52.24659319087319, -75, 180},
                                    {270, 158.29529767543877, -40.24922359499619, 40.59062371834447,
                                     -52.23875609296496, 243.434948822922}};
  const double a = 45 * kRadPerDeg, b = 30 * kRadPerDeg;
  for (const auto& s : kSamples) {
    const double phi = s[0] * kRadPerDeg;
    const Vec3 tip =
        rotation_y(b) * Vec3(40 * std::cos(phi), 40 * std::sin(phi), 0) + Vec3(-65, 0, 150);
    const Vec3 axis = rotation_y(b) *
                      Vec3(-std::sin(a) * std::cos(phi), -std::sin(a) * std::sin(phi), std::cos(a));
    AxisPositions near;
    near[B] = s[4] * kRadPerDeg, near[C] = s[5] * kRadPerDeg;
    const auto solution = inverse(machine, {tip, axis}, 0.0, near);
    ASSERT_TRUE(solution);
    const AxisPositions& q = solution->front().axes;
    EXPECT_NEAR(q[X], s[1], 1e-9);
    EXPECT_NEAR(q[Y], s[2], 1e-9);
    EXPECT_NEAR(q[Z], s[3], 1e-9);
    EXPECT_NEAR(q[B] * kDegPerRad, s[4], 1e-9);
    EXPECT_NEAR(q[C] * kDegPerRad, s[5], 1e-9);
  }
}

TEST(ChainReference, HasTheOffsetsOfTheDvf5000) {
  const Machine machine = shipped("dvf5000");
  // At Z = -479 the tip of the 150 mm tool is on the table.
  AxisPositions q;
  q[Z] = -479.0;
  EXPECT_NEAR(nominal_pose(machine, q, 150.0).translation.norm(), 0.0, 1e-9);
  // Gains of Table 4-3 at Y = -225, Z = -480 (um per urad): a 1 urad error moves the tip by the
  // lever.
  q[Y] = -225.0, q[Z] = -480.0;
  const auto moved = [&](const std::string& error) {
    return Vec3((actual_pose(machine, errors(machine, {error}), q, 150.0).translation -
                 nominal_pose(machine, q, 150.0).translation) *
                1e3);
  };
  EXPECT_LT((moved("exX=1urad") - Vec3(0, 0.474, -0.9425)).norm(), 2e-6);
  EXPECT_LT((moved("eyX=1urad") - Vec3(-0.474, 0, -0.136)).norm(), 2e-6);
  EXPECT_LT((moved("ezY=1urad") - Vec3(1.074, -0.07, 0)).norm(), 2e-6);
  EXPECT_LT((moved("exZ=1urad") - Vec3(0, 0.96, -0.242)).norm(), 2e-6);
  EXPECT_LT((moved("gXY=1urad") - Vec3(1.299, -0.07, 0)).norm(), 2e-6);
  EXPECT_LT((moved("aYZ=1urad") - Vec3(0, 1.44, -0.242)).norm(), 2e-6);
  EXPECT_LT((moved("bXZ=1urad") - Vec3(-1.44, 0, 0)).norm(), 2e-6);
}

// One chain as docs/errors.md writes it: every joint a product of elementary transforms.
Pose as_written(const Machine& machine, const std::vector<Joint>& joints, const Vec3& end,
                const GeometricErrors& errors, const AxisPositions& q) {
  const auto turned = [&](double a, double b, double c) {
    const Pose x = Pose::rotated(rotation_x(a)), y = Pose::rotated(rotation_y(b)),
               z = Pose::rotated(rotation_z(c));
    return machine.rotation_order() == RotationOrder::zyx ? z * y * x : x * y * z;
  };
  const auto about = [](const Vec3& p, const Pose& turn) {
    return Pose::translated(p) * turn * Pose::translated(-p);
  };
  Pose pose;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const Joint& joint = joints[i];
    const AxisErrors& e = errors[joint.letter];
    const auto f = [&](std::size_t k) { return e.component[k](joint.letter, q); };
    const Pose rotate =
        Pose::rotated(rotation_about(joint.direction, joint.side * q[joint.letter]));
    const bool rotor = machine.rotary_error_frame() == RotaryErrorFrame::rotor;
    Vec3 pivot = joint.functional_point.point;
    if (joint.functional_point.at_tip) {
      Pose from_end = Pose::translated(end);
      for (std::size_t k = joints.size(); k-- > i + 1;) {
        const Joint& later = joints[k];
        const double move = later.side * q[later.letter];
        from_end = Pose::translated(later.offset) *
                   (later.rotary() ? Pose::rotated(rotation_about(later.direction, move))
                                   : Pose::translated(move * later.direction)) *
                   from_end;
      }
      if (joint.rotary() && !rotor) from_end = rotate * from_end;
      pivot = from_end.translation;
    }
    const Pose shift = Pose::translated({f(0), f(1), f(2)});
    const Pose turn = about(pivot, turned(f(3), f(4), f(5)));
    const Pose orientation = turned(e.location[3], e.location[4], e.location[5]);
    pose = pose * Pose::translated(joint.offset) *
           Pose::translated({e.location[0], e.location[1], e.location[2]});
    if (joint.rotary()) {
      pose = pose * orientation * (rotor ? rotate * turn * shift : shift * turn * rotate);
    } else {
      const Vec3 motion = joint.side * q[joint.letter] * joint.direction;
      const Vec3 line = motion + orientation.direction(motion + pivot) - (motion + pivot);
      pose = pose * turned(e.carried_tilt.x(), e.carried_tilt.y(), e.carried_tilt.z()) *
             Pose::translated(line) * shift * turn;
    }
  }
  return pose * Pose::translated(end);
}

TEST(ChainLaws, IsTheProductOfElementaryTransformsOnRandomMachinesWithAllErrors) {
  for (std::uint32_t k = 0; k < 40; ++k) {
    RandomMachine random(k);
    const Machine machine = machine_of(random.text());
    // Every fourth machine has errors beyond those whose sine and cosine are taken from the series.
    const double rad = k % 4 == 0 ? 0.1 : 1e-3;
    GeometricErrors e;
    for (const Joint& joint : machine.joints()) {
      AxisErrors& axis = e[joint.letter];
      for (std::size_t d = 0; d < 6; ++d) {
        const double size = d < 3 ? 0.5 : rad;
        axis.location[d] = random.signed_draw(size);
        axis.component[d] = ErrorFunction({ConstantTerm{random.signed_draw(size)},
                                           LinearTerm{random.signed_draw(size / 200.0), 3.0}});
      }
      if (!joint.rotary()) {
        axis.carried_tilt = {random.signed_draw(rad), random.signed_draw(rad),
                             random.signed_draw(rad)};
      }
    }
    const ForwardChain chain(machine, e, 120.0);
    for (int i = 0; i < 5; ++i) {
      const AxisPositions q = random.position();
      const Pose tool = as_written(machine, machine.tool_chain(),
                                   machine.spindle_offset() - Vec3(0, 0, 120.0), e, q);
      const Pose table = as_written(machine, machine.work_chain(), machine.table_offset(), e, q);
      // 1e-12 of the lengths in the chain, which add up to two metres.
      EXPECT_LT(difference(chain.bed_from_tool(q), tool), 2e-9) << machine.structure();
      EXPECT_LT(difference(chain.bed_from_table(q), table), 2e-9) << machine.structure();
      EXPECT_LT(difference(chain.table_from_tool(q), table.inverse() * tool), 2e-9);
    }
  }
}

TEST(Chain, IsTheNominalMachineWithoutErrors) {
  for (const char* name :
       {"zx-yac", "iwf-bc", "dvf5000", "double-pivot-head", "swivel-head-table", "three-axis"}) {
    const Machine machine = shipped(name);
    AxisPositions q;
    q[X] = 10, q[Y] = -20, q[Z] = 30, q[A] = 0.3, q[B] = -0.4, q[C] = 1.2;
    EXPECT_EQ(difference(actual_pose(machine, {}, q, 77.0), nominal_pose(machine, q, 77.0)), 0.0)
        << name;
  }
}

TEST(Chain, MovesTheTipInTheNamedDirectionOnEitherSide_Complaint04) {
  // Complaint 4: ISO 841 signs. +q of a linear axis moves the tool, relative to the work, along +e.
  for (const char* name :
       {"zx-yac", "iwf-bc", "double-pivot-head", "swivel-head-table", "three-axis"}) {
    const Machine machine = shipped(name);
    for (const AxisLetter letter : {X, Y, Z}) {
      AxisPositions q;
      q[letter] = 7.0;
      const Vec3 moved =
          nominal_pose(machine, q, 0.0).translation - nominal_pose(machine, {}, 0.0).translation;
      EXPECT_LT((moved - 7.0 * Vec3::Unit(static_cast<Eigen::Index>(letter))).norm(), 1e-12)
          << name;
    }
  }
  // Joint values of the tables: a workpiece-side axis turns the tool, seen from the work, by +q.
  AxisPositions q;
  q[A] = 30 * kRadPerDeg;
  EXPECT_LT((tool_pose(nominal_pose(shipped("zx-yac"), q, 0)).axis - Vec3(0, -0.5, std::sqrt(0.75)))
                .norm(),
            1e-12);
  q = {};
  q[B] = 30 * kRadPerDeg;
  for (const char* name : {"iwf-bc", "double-pivot-head", "swivel-head-table"}) {
    EXPECT_LT(
        (tool_pose(nominal_pose(shipped(name), q, 0)).axis - Vec3(0.5, 0, std::sqrt(0.75))).norm(),
        1e-12);
  }
}

TEST(Chain, LeavesTheConeUnchangedByATurnOfTheSpindleFrame) {
  // A displacement along the tool axis moves the tip along it and nowhere else.
  const Machine machine = shipped("iwf-bc");
  AxisPositions q;
  q[X] = 50, q[Z] = 100, q[B] = -0.6, q[C] = 2.0;
  const Pose nominal = nominal_pose(machine, q, 150.0);
  const Vec3 moved = actual_pose(machine, errors(machine, {"EZ0Z=10um"}), q, 150.0).translation -
                     nominal.translation;
  EXPECT_LT((moved - 0.01 * nominal.rotation.col(2)).norm(), 1e-13);
}

}  // namespace
}  // namespace frustum::kinematics
