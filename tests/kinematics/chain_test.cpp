#include "kinematics/chain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "kinematics/inverse.hpp"
#include "tests/kinematics/machines.hpp"

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

double draw(std::uint64_t index, double size) {
  return size * (2.0 * uniform({.seed = 21}, index) - 1.0);
}

Pose d1(double v) { return Pose::translated({v, 0, 0}); }
Pose d2(double v) { return Pose::translated({0, v, 0}); }
Pose d3(double v) { return Pose::translated({0, 0, v}); }
Pose d4(double v) { return Pose::rotated(rotation_x(v)); }
Pose d5(double v) { return Pose::rotated(rotation_y(v)); }
Pose d6(double v) { return Pose::rotated(rotation_z(v)); }

double difference(const Pose& a, const Pose& b) {
  return std::max((a.translation - b.translation).norm(), 100.0 * (a.rotation - b.rotation).norm());
}

TEST(ChainReference, ReproducesIbarakiEquations1To5WithAllElevenErrors) {
  const Machine machine = shipped("zx-yac");
  const double a_AY = 31e-6, b_AY = -22e-6, g_AY = 17e-6, b_CA = 12e-6, dx = 3e-3, dy = -4e-3,
               dz = 5e-3, dy_CA = 2e-3, g_YX = 40e-6, a_ZY = -15e-6, b_ZX = 9e-6;
  const auto e =
      errors(machine, {"alpha_AY=31urad", "beta_AY=-22urad", "gamma_AY=17urad", "beta_CA=12urad",
                       "dx_AY=3um", "dy_AY=-4um", "dz_AY=5um", "dy_CA=2um", "gamma_YX=40urad",
                       "alpha_ZY=-15urad", "beta_ZX=9urad"});
  for (std::uint64_t k = 0; k < 100; ++k) {
    AxisPositions q;
    q[X] = draw(5 * k, 200), q[Y] = draw(5 * k + 1, 200), q[Z] = draw(5 * k + 2, 200);
    q[A] = draw(5 * k + 3, 1.5), q[C] = draw(5 * k + 4, 3.0);
    const Pose tool = d1(q[X]) * d4(a_ZY) * d5(b_ZX) * d3(q[Z]);
    const Pose work = d6(-g_YX) * d2(-q[Y]) * d1(dx) * d2(dy) * d3(dz) * d4(a_AY) * d5(b_AY) *
                      d6(g_AY) * d4(-q[A]) * d2(dy_CA) * d5(b_CA) * d6(-q[C]);
    EXPECT_LT(difference(actual_pose(machine, e, q, 0.0), work.inverse() * tool), 1e-11);
  }
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

TEST(ChainReference, FollowsBossoniEquations319And322OnHeadMachines) {
  // XYZ is the place of the B/C crossing: Rz(gamma)(P1 + l u1), seen from the turned table if there is one.
  const double l = 150.0, beta = 0.5, alpha = 0.7;
  for (double phi = 0.1; phi < 6.2; phi += 0.5) {
    const Vec3 tip = rotation_y(beta) * Vec3(40 * std::cos(phi), 40 * std::sin(phi), 0);
    const Vec3 u = rotation_y(beta) * Vec3(-std::sin(alpha) * std::cos(phi),
                                           -std::sin(alpha) * std::sin(phi), std::cos(alpha));
    const Machine head = shipped("double-pivot-head");
    const auto q = inverse(head, {tip, u}, l, {});
    ASSERT_TRUE(q);
    const Vec3 crossing = tip + l * u;
    EXPECT_LT((Vec3(q->front().axes[X], q->front().axes[Y], q->front().axes[Z]) - crossing).norm(),
              1e-10);
    const Machine mixed = shipped("swivel-head-table");
    const auto m = inverse(mixed, {tip, u}, l, {});
    ASSERT_TRUE(m);
    const Vec3 seen = rotation_z(-m->front().axes[C]) * crossing;
    EXPECT_LT((Vec3(m->front().axes[X], m->front().axes[Y], m->front().axes[Z]) - seen).norm(),
              1e-10);
  }
}

TEST(ChainReference, HasTheOffsetsOfTheDvf5000) {
  const Machine machine = shipped("dvf5000");
  // At Z = -479 the tip of the 150 mm tool is on the table.
  AxisPositions q;
  q[Z] = -479.0;
  EXPECT_NEAR(nominal_pose(machine, q, 150.0).translation.norm(), 0.0, 1e-9);
  // Gains of Table 4-3 at Y = -225, Z = -480 (um per urad): a 1 urad error moves the tip by the lever.
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
