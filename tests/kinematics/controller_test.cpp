#include "kinematics/controller/controller.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "kinematics/model/chain.hpp"
#include "parser/interpreter.hpp"
#include "tests/kinematics/executing.hpp"
#include "tests/kinematics/machines.hpp"

namespace frustum::kinematics {
namespace {

using enum parser::AxisLetter;

Setup nc_setup() {
  Setup s;
  s.work_offsets = {{1, Vec3(10, 20, 30)}, {6, Vec3::Zero()}};
  s.tools = {{1, {.length = 100.0}}, {2, {.length = 80.0}}};
  return s;
}

Result<Execution> run_nc(const std::string& machine, const std::string& nc,
                         const Setup& with = nc_setup()) {
  const auto program = parser::parse_program(nc, "test.nc");
  if (!program) return program.error();
  const auto motions = parser::motions_of(*program);
  if (!motions) return motions.error();
  const Machine loaded = shipped(machine);
  return execute(loaded, {}, with, *motions);
}

std::string run_problem(const std::string& machine, const std::string& nc) {
  const auto result = run_nc(machine, nc);
  if (result) return "accepted";
  const Diagnostic& d = result.error().front();
  return std::to_string(d.line) + ": " + d.message;
}

TEST(Controller, KeepsTheTipWhileTheToolTurnsUnderTcp_Complaint05) {
  // Complaint 5: the tip must not move by L sin B while only the orientation changes.
  for (const char* machine : {"iwf-bc", "double-pivot-head", "swivel-head-table"}) {
    const auto e =
        run_nc(machine,
               "G21 G90\nT1 M6\nS1000 M3\nG54 G43.4 H1\nG0 X5 Y6 Z150 B0 C0\nG1 X5 Y6 Z150 "
               "B-35 C70 F500\n");
    ASSERT_TRUE(e) << to_string(e.error().front());
    const ToolPath& path = e->path;
    const std::uint32_t first = path.segments.back().first_pose;
    for (std::uint32_t i = path.segments.size() > 400 ? first - 100 : 1; i <= first; ++i) {
      if (path.blocks[path.segments[i - 1].block].kind == PathKind::feed) {
        EXPECT_LT((path.poses[i].tip - Vec3(15, 26, 180)).norm(), 1e-9);
      }
    }
    EXPECT_LT((path.poses.back().axis -
               rotation_z(70 * kRadPerDeg) * rotation_y(-35 * kRadPerDeg) * Vec3::UnitZ())
                  .norm(),
              1e-12);
  }
}

TEST(Controller, GivesTheSamePathForVectorsAndAngles) {
  const auto angles =
      run_nc("iwf-bc",
             "G21 G90\nT1 M6\nG54 G43.4 H1\nG0 X0 Y0 Z100 B-20 C30\nG1 X9 Y3 Z98 B-25 C40 F500\n");
  const Vec3 u0 = rotation_z(30 * kRadPerDeg) * rotation_y(-20 * kRadPerDeg) * Vec3::UnitZ();
  const Vec3 u1 = rotation_z(40 * kRadPerDeg) * rotation_y(-25 * kRadPerDeg) * Vec3::UnitZ();
  char nc[400];
  std::snprintf(nc, sizeof nc,
                "G21 G90\nT1 M6\nG54 G43.5 H1\nG0 X0 Y0 Z100 I%.12f J%.12f K%.12f\nG1 X9 Y3 Z98 "
                "I%.12f J%.12f K%.12f F500\n",
                u0.x(), u0.y(), u0.z(), u1.x(), u1.y(), u1.z());
  const auto vectors = run_nc("iwf-bc", nc);
  ASSERT_TRUE(angles && vectors);
  ASSERT_EQ(angles->path.poses.size(), vectors->path.poses.size());
  for (std::size_t i = 0; i < angles->path.poses.size(); ++i) {
    EXPECT_LT((angles->path.poses[i].tip - vectors->path.poses[i].tip).norm(), 1e-8);
  }
}

TEST(Controller, StartsAtTheMachinesHomeAndCutsNothingBefore_Complaint11) {
  // Complaint 11: a simulator that starts at the program's zero gouges the part with the first
  // move.
  const auto e =
      run_nc("three-axis", "G21 G90\nT1 M6\nS1000 M3\nG54 G43 H1\nG0 X0 Y0 Z50\nG1 Z40 F100\n");
  ASSERT_TRUE(e);
  const AxisPositions& start = e->axes.front().axes;
  EXPECT_EQ(start[Z], 500.0);
  EXPECT_LT((e->path.poses.front().tip - Vec3(0, 0, 400)).norm(), 1e-12);
  EXPECT_LT((e->path.poses.back().tip - Vec3(10, 20, 70)).norm(), 1e-9);
}

TEST(Controller, CutsArcsInTheirOwnPlane_Complaint14) {
  // Complaint 14: a quarter circle of radius 10 about the origin in each plane, both senses.
  const struct {
    const char* plane;
    const char* start;
    const char* arc;
    Vec3 middle;
  } cases[] = {
      {"G17", "X10 Y0 Z50", "G3 X0 Y10 I-10 J0", Vec3(std::sqrt(50.), std::sqrt(50.), 50)},
      {"G17", "X10 Y0 Z50", "G2 X0 Y10 I-10 J0", Vec3(-std::sqrt(50.), -std::sqrt(50.), 50)},
      {"G18", "X10 Y7 Z50", "G2 X0 Z60 I-10 K0", Vec3(std::sqrt(50.), 7, 50 + std::sqrt(50.))},
      {"G18", "X10 Y7 Z50", "G3 X0 Z60 I-10 K0", Vec3(-std::sqrt(50.), 7, 50 - std::sqrt(50.))},
      {"G19", "X3 Y10 Z50", "G3 Y0 Z60 J-10 K0", Vec3(3, std::sqrt(50.), 50 + std::sqrt(50.))},
      {"G19", "X3 Y10 Z50", "G2 Y0 Z60 J-10 K0", Vec3(3, -std::sqrt(50.), 50 - std::sqrt(50.))}};
  for (const auto& c : cases) {
    const auto e =
        run_nc("three-axis", std::string("G21 G90 ") + c.plane + "\nT1 M6\nG59 G43 H1\nG0 " +
                                 c.start + "\n" + c.arc + " F100\n");
    ASSERT_TRUE(e) << to_string(e.error().front());
    double nearest = 1e9, off = 0.0;
    for (const PathSegment& s : e->path.segments) {
      if (e->path.blocks[s.block].kind != PathKind::feed) continue;
      nearest = std::min(nearest, (e->path.to(s).tip - c.middle).norm());
      const Vec3 centre = Vec3(c.plane[2] == '9' ? 3 : 0, c.plane[2] == '8' ? 7 : 0, 50);
      off = std::max(off, std::abs((e->path.to(s).tip - centre).norm() - 10.0));
    }
    EXPECT_LT(nearest, 0.1) << c.plane << c.arc;
    EXPECT_LT(off, 1e-9) << c.plane << c.arc;
  }
}

TEST(Controller, NeverReplacesATool_Complaint15) {
  EXPECT_EQ(run_problem("three-axis", "G21 G90\nT7 M6\n"), "2: tool T7 is not defined");
  EXPECT_EQ(run_problem("three-axis", "G21 G90\nT1 M6\nG54 G43 H9\n"),
            "3: H9: there is no tool length of that number");
  EXPECT_EQ(run_problem("three-axis", "G21 G90\nG54\nG1 X1 Y1 Z400 F100\n"),
            "3: feed move without a tool in the spindle");
}

TEST(Controller, NamesPlaceAndRemedyOfWhatItCannotDo) {
  EXPECT_EQ(run_problem("three-axis", "G21 G90\nT1 M6\nG54 G43 H1\nG0 X0 Y0 Z50\nG1 X900 F100\n"),
            "5: over-travel: X = 910.0000 mm, travel -400 .. 400");
  EXPECT_EQ(run_problem("three-axis", "G21 G90\nT1 M6\nG54\nG0 X0 A10\n"),
            "4: machine three-axis (t-(C)-Z-b-Y-X-w) has no axis A");
  EXPECT_EQ(run_problem("iwf-bc", "G21 G90\nT1 M6\nG55\nG0 X0\n"),
            "3: work offset G55 is not defined");
  EXPECT_EQ(
      run_problem("three-axis", "G21 G90\nT1 M6\nG54 G43.5 H1\nG0 X0 Y0 Z50 I0.1 J0 K1\n"),
      "4: tool direction (0.099504, 0.000000, 0.995037) is 5.710593 deg off the spindle, and the "
      "machine has no rotary axis");
}

}  // namespace
}  // namespace frustum::kinematics
