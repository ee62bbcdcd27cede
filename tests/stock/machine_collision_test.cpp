// What bodies of machines, fixtures, tools and blank meet along programs.
#include "stock/collision/machine_collision.hpp"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "tests/kinematics/machines.hpp"

namespace frustum::stock {
namespace {

using kinematics::AxisLetter;
using kinematics::CommandedMove;
using kinematics::CommandedProgram;
using kinematics::Machine;
using kinematics::MachineBody;
using kinematics::shipped;

// Vertical mill, the work on X: a table whose top is at z = -50, a spindle head above the gauge
// point.
const char* const kMill = R"(
name = "mill"
structure = "t-(C)-Z-Y-b-X-w"
[axis.X]
travel = [-500, 500]
[axis.Y]
travel = [-500, 500]
[axis.Z]
travel = [-500, 500]
home = 400
[[bodies]]
name = "table"
on = "table"
shape = "box"
size = [800, 600, 50]
origin = [0, 0, -100]
[[bodies]]
name = "head"
on = "spindle"
shape = "cylinder"
diameter = 100
height = 200
)";

Machine mill(const std::string& more = "") {
  auto machine = Machine::read(std::string(kMill) + more, "mill.toml");
  EXPECT_TRUE(machine) << (machine ? "" : to_string(machine.error().front()));
  return *std::move(machine);
}

kinematics::AxisPositions at(double x, double y, double z) {
  kinematics::AxisPositions q;
  q[AxisLetter::X] = x;
  q[AxisLetter::Y] = y;
  q[AxisLetter::Z] = z;
  return q;
}

// One move a line, from line 1.
CommandedProgram going(const std::vector<kinematics::AxisPositions>& places, int tool) {
  CommandedProgram program;
  program.start = places.front();
  for (std::size_t k = 1; k < places.size(); ++k) {
    program.steps.emplace_back(
        CommandedMove{.motion = kinematics::axes_motion(places[k - 1], places[k]),
                      .source_line = static_cast<std::uint32_t>(k),
                      .kind = kinematics::PathKind::rapid,
                      .tool = tool});
  }
  return program;
}

std::map<int, cutter::Cutter> mill_of_10() {
  cutter::CutterSpec spec;
  spec.diameter = Mm{10.0};
  spec.length = Mm{100.0};
  return {{1, *cutter::Cutter::make(spec)}};
}

MachineCollisions found_on(const Machine& machine, const std::vector<MachineBody>& fixtures,
                           const std::vector<kinematics::AxisPositions>& places, int tool = 1,
                           const BlankShape& blank = BoxShape{20, 20, 20}) {
  kinematics::Setup setup;
  setup.tools[1] = {.length = 100.0};
  const auto scene =
      scene_of(machine, fixtures, setup, mill_of_10(), *Blank::make(blank, Vec3(300, 0, -40)));
  EXPECT_TRUE(scene);
  return find_machine_collisions(*scene, setup, going(places, tool));
}

TEST(MachineCollision, OfARapidIntoTheTableHasItsLineAndPlace_Fault2_25) {
  // The tip is at z = q - 100: it meets the table, whose top is at -50, at q = 50.
  const MachineCollisions found =
      found_on(mill(), {}, {at(0, 0, 300), at(100, 50, 300), at(100, 50, 20), at(100, 50, 300)});
  ASSERT_EQ(found.collisions.size(), 1U);
  const Collision& c = found.collisions[0];
  EXPECT_EQ(c.kind, CollisionKind::bodies_meet);
  EXPECT_EQ(c.first, "table");
  EXPECT_EQ(c.second, "cutter");
  EXPECT_EQ(c.source_line, 2U);
  EXPECT_EQ(c.last_line, 3U);  // on its way up
  EXPECT_EQ(c.block, 1U);
  // X of the work: the tool is at +100 of the table; a point of the end mill's end.
  EXPECT_LE((c.point - Vec3(100, 50, -50)).norm(), 5.01);
  EXPECT_NEAR(c.point.z(), -50.0, 0.03);
  ASSERT_TRUE(found.closest);
  EXPECT_EQ(found.closest->distance, 0.0);  // they have met
}

// A disc of 90 m in the work's way: followed by parts of each way, not millimetre by millimetre.
TEST(MachineCollision, OfBodiesAsLargeAsTheyMayBeEnds_Fault2_25) {
  const MachineBody disc{.name = "disc",
                         .shape = kinematics::CylinderBody{9e4, 10.0},
                         .part_from_body = Pose::translated({0, 0, -55})};
  std::vector<kinematics::AxisPositions> places;
  for (int k = 0; k < 100; ++k) places.push_back(at(k % 2 == 0 ? -500 : 500, k, 300));
  EXPECT_TRUE(found_on(mill(), {disc}, places).collisions.empty());
  places.push_back(at(0, 0, 20));
  EXPECT_EQ(found_on(mill(), {disc}, places).collisions.size(), 2U);  // disc and table
}

TEST(MachineCollision, OfABodyThatIsTooFarOffIsNotLookedFor_Fault2_25) {
  const Machine machine = mill();
  const auto refused = [&](const MachineBody& body) {
    const auto scene = scene_of(machine, std::array{body}, {}, mill_of_10(),
                                *Blank::make(BoxShape{20, 20, 20}, Vec3::Zero()));
    return !scene && scene.error().front().message.find("'post'") != std::string::npos;
  };
  const kinematics::BoxBody small{{10, 10, 10}};
  EXPECT_FALSE(refused({.name = "post", .shape = small}));
  EXPECT_TRUE(
      refused({.name = "post", .shape = small, .part_from_body = Pose::translated({0, 1e300, 0})}));
  EXPECT_TRUE(refused({.name = "post", .shape = kinematics::BoxBody{{10, 1e9, 10}}}));
}

TEST(MachineCollision, SmallestDistanceHasItsLine_Fault2_25) {
  const MachineCollisions found =
      found_on(mill(), {}, {at(0, 0, 300), at(100, 50, 300), at(100, 50, 57), at(100, 50, 300)});
  EXPECT_TRUE(found.collisions.empty());
  ASSERT_TRUE(found.closest);
  EXPECT_NEAR(found.closest->distance, 7.0, 0.08);  // 1 %
  EXPECT_EQ(found.closest->first, "table");
  EXPECT_EQ(found.closest->second, "cutter");
  EXPECT_EQ(found.closest->source_line, 2U);
}

TEST(MachineCollision, OfAThinFixtureIsNotTunnelledThrough_Fault2_25) {
  // 0.1 mm thin, crossed by the tool within one rapid of 600 mm.
  const MachineBody wall{.name = "wall",
                         .shape = kinematics::BoxBody{{0.1, 200, 50}},
                         .part_from_body = Pose::translated({0, 0, -40})};
  const std::vector<kinematics::AxisPositions> through{at(-300, 0, 90), at(300, 0, 90)};
  const MachineCollisions found = found_on(mill(), {wall}, through);
  ASSERT_EQ(found.collisions.size(), 1U);
  EXPECT_EQ(found.collisions[0].first, "wall");
  EXPECT_NEAR(found.collisions[0].point.x(), -0.05, 0.03);
  // Above it: the tip at -40 + 50 + 2.
  EXPECT_TRUE(found_on(mill(), {wall}, {at(-300, 0, 112), at(300, 0, 112)}).collisions.empty());
  // Without a tool the head passes over it.
  EXPECT_TRUE(found_on(mill(), {wall}, through, 0).collisions.empty());
}

TEST(MachineCollision, OfTheHeadAndTheBlankAndNotOfToolAndBlank_Fault2_25) {
  // The blank's top is at z = 60 of the table, the head's bottom at the gauge point: at q = 50 it
  // goes through it, and so does the tool, which cuts.
  const auto found = found_on(mill(), {}, {at(0, 0, 65), at(300, 0, 65), at(400, 0, 55)}, 0,
                              BoxShape{40, 40, 100});
  ASSERT_EQ(found.collisions.size(), 1U);
  EXPECT_EQ(found.collisions[0].first, "head");
  EXPECT_EQ(found.collisions[0].second, "blank");
  EXPECT_EQ(found.collisions[0].source_line, 2U);
}

TEST(MachineCollision, BodiesThatTouchAtHomeAreToldAndThoseToIgnoreAreNot_Fault2_25) {
  const std::string guard =
      "[[bodies]]\nname = \"guard\"\non = \"Y\"\nshape = \"box\"\nsize = [120, 120, 50]\n"
      "origin = [0, 0, 580]\n";
  const auto touching = found_on(mill(guard), {}, {at(0, 0, 300), at(100, 0, 300)});
  ASSERT_EQ(touching.warnings.size(), 1U);
  EXPECT_EQ(touching.warnings[0].id, "bodies-touch"_id);
  const auto ignored =
      found_on(mill(guard + "ignore = [\"head\"]\n"), {}, {at(0, 0, 300), at(100, 0, 300)});
  EXPECT_TRUE(ignored.warnings.empty());
  EXPECT_TRUE(ignored.collisions.empty());
}

TEST(MachineCollision, WithoutBodiesNothingWasLookedFor_Fault2_25) {
  std::string text = kMill;
  text.resize(text.find("[[bodies]]"));
  const auto found =
      found_on(*Machine::read(text, "mill.toml"), {}, {at(0, 0, 300), at(0, 0, -400)});
  EXPECT_EQ(found.bodies, 0U);
  EXPECT_FALSE(found.closest);
}

TEST(MachineCollision, MeshesAreMetAsBoxesOfTheirSize_Fault2_25) {
  // The wall of a box of facets, 40 x 200 x 50, in a file; and what is wholly inside it.
  const auto file = std::filesystem::temp_directory_path() /
                    ("frustum-body-" + std::to_string(::getpid()) + ".obj");
  std::ofstream obj(file);
  for (const double z : {0.0, 50.0}) {
    for (const double y : {-100.0, 100.0}) {
      for (const double x : {-20.0, 20.0}) obj << "v " << x << ' ' << y << ' ' << z << '\n';
    }
  }
  obj << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  obj.close();
  const MachineBody mesh{.name = "block",
                         .shape = kinematics::MeshBody{file},
                         .part_from_body = Pose::translated({0, 0, -40})};
  const MachineBody box{.name = "block",
                        .shape = kinematics::BoxBody{{40, 200, 50}},
                        .part_from_body = Pose::translated({0, 0, -40})};
  const std::vector<std::vector<kinematics::AxisPositions>> ways{
      {at(-300, 0, 90), at(300, 0, 90)},                  // through
      {at(-300, 0, 113), at(300, 20, 113)},               // 3 mm above
      {at(-300, 110, 90), at(300, 110, 90)},              // 5 mm beside
      {at(-300, 0, 300), at(0, 0, 300), at(0, 0, 105)}};  // into it from above
  for (const auto& way : ways) {
    const auto of_mesh = found_on(mill(), {mesh}, way);
    const auto of_box = found_on(mill(), {box}, way);
    ASSERT_EQ(of_mesh.collisions.size(), of_box.collisions.size());
    for (std::size_t k = 0; k < of_box.collisions.size(); ++k) {
      EXPECT_EQ(of_mesh.collisions[k].source_line, of_box.collisions[k].source_line);
    }
    EXPECT_NEAR(of_mesh.closest->distance, of_box.closest->distance,
                0.03 + 0.02 * of_box.closest->distance);
  }
  const auto solid = *solid_of(mesh.shape);
  const SolidBody pin = SolidBody::of(BoxShape{2, 2, 2});
  EXPECT_EQ(separation(solid, pin, Pose::translated({0, 0, 20})).upper, 0.0);
  EXPECT_EQ(separation(pin, solid, Pose::translated({0, 0, -20})).upper, 0.0);
  EXPECT_NEAR(separation(solid, pin, Pose::translated({0, 0, 57})).upper, 7.0, 1e-5);
  std::filesystem::remove(file);
}

TEST(MachineCollision, Attack3_4_MeshesThatBoundNoBodyAreRefused) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("frustum-open-body-" + std::to_string(::getpid()) + ".obj");
  const std::string corners = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\n";
  const auto read_from = [&](const std::string& facets) {
    std::ofstream(file) << corners << facets;
    return solid_of(kinematics::MeshBody{file});
  };
  EXPECT_TRUE(read_from("f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"));
  const auto open = read_from("f 1 3 2\nf 1 2 4\nf 2 3 4\n");
  ASSERT_FALSE(open);
  EXPECT_EQ(open.error().front().id.text(), "body-open");
  EXPECT_EQ(open.error().front().file, file.string());
  const auto turned = read_from("f 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n");
  ASSERT_FALSE(turned);
  EXPECT_EQ(turned.error().front().id.text(), "body-inside-out");
  std::filesystem::remove(file);
}

TEST(MachineCollision, IsTheSameForAnyNumberOfThreads_Fault2_25) {
  const Machine machine = shipped("zx-yac");
  std::vector<kinematics::AxisPositions> places;
  for (std::uint64_t k = 0; k < 12; ++k) places.push_back(random_axes(machine, k));
  const auto run = [&] { return found_on(machine, {}, places); };
  const MachineCollisions many = run();
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const MachineCollisions alone = run();
  ASSERT_EQ(many.collisions.size(), alone.collisions.size());
  EXPECT_FALSE(many.collisions.empty());
  for (std::size_t k = 0; k < many.collisions.size(); ++k) {
    EXPECT_EQ(many.collisions[k].point, alone.collisions[k].point);
    EXPECT_EQ(many.collisions[k].first, alone.collisions[k].first);
    EXPECT_EQ(many.collisions[k].last_line, alone.collisions[k].last_line);
  }
  EXPECT_EQ(many.closest->distance, alone.closest->distance);
}

}  // namespace
}  // namespace frustum::stock
