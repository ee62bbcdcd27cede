// A program that is travelled as it is read gives what one that is held as a whole does.
#include "trials/travel_as_read.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <cmath>
#include <string>

namespace frustum::trials {
namespace {

kinematics::Machine machine_of(const std::string& name) {
  return *kinematics::Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name);
}

programs::TestPiece piece_of(const std::string& nc) {
  programs::TestPiece piece;
  piece.program = nc;
  piece.program_file = "wave.ngc";
  piece.dialect = parser::Dialect::linuxcnc;
  piece.work_offsets = {{1, Vec3(0, 0, 100)}};
  piece.tools[1] = {.diameter = 10.0_mm, .length = 100.0_mm, .flute_length = 40.0_mm};
  piece.blank = stock::BoxShape{100.0, 100.0, 20.0};
  return piece;
}

// Lines, arcs, a dwell, a word of the builder; more motions than one portion has.
std::string wave(int blocks, const std::string& end = "M30\n") {
  std::string nc =
      "G21 G90 G17 G54\nT1 M6\nG43 H1\nS12000 M3\nM101\nG0 X-50 Y-50 Z40\nG1 Z10 F3000\n";
  for (int i = 0; i < blocks; ++i) {
    const double x = 100.0 * i / blocks - 50.0;
    nc += fmt::format("X{:.4f} Y{:.4f} Z{:.4f}\n", x, 20.0 * std::sin(0.1 * i),
                      10.0 + std::cos(0.01 * i));
    if (i % 1000 == 0) nc += "G2 I5 J0\nG4 P0.1\nG1\n";
  }
  return nc + "G0 Z40\n" + end;
}

TrialOptions as_read() { return {.measure = false, .poses_alone = true}; }
TrialOptions as_a_whole() { return {.measure = false}; }

void expect_same(const Trial& read, const Trial& whole) {
  const kinematics::ToolPath &a = read.workpiece->removed().path(),
                             &b = whole.workpiece->removed().path();
  ASSERT_EQ(a.poses.size(), b.poses.size());
  ASSERT_EQ(a.segments.size(), b.segments.size());
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    different += a.poses[i].tip != b.poses[i].tip || a.poses[i].axis != b.poses[i].axis;
  }
  for (std::size_t i = 0; i < a.segments.size(); ++i) {
    different += a.segments[i].first_pose != b.segments[i].first_pose ||
                 a.segments[i].block != b.segments[i].block;
  }
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    different += a.blocks[i].source_line != b.blocks[i].source_line ||
                 a.blocks[i].tool != b.blocks[i].tool || a.blocks[i].kind != b.blocks[i].kind ||
                 a.blocks[i].duration != b.blocks[i].duration;
  }
  EXPECT_EQ(different, 0U);
  EXPECT_EQ(a.times, b.times);
  EXPECT_TRUE(a.axes.empty());
  EXPECT_FALSE(b.axes.empty());
  EXPECT_EQ(read.cycle_time, whole.cycle_time);
  ASSERT_EQ(read.collisions.size(), whole.collisions.size());
  for (std::size_t i = 0; i < read.collisions.size(); ++i) {
    EXPECT_EQ(read.collisions[i].source_line, whole.collisions[i].source_line);
    EXPECT_EQ(read.collisions[i].point, whole.collisions[i].point);
  }
  const auto &near = read.machine_collisions.closest,
             &near_whole = whole.machine_collisions.closest;
  ASSERT_TRUE(near && near_whole);
  EXPECT_EQ(near->distance, near_whole->distance);
  EXPECT_EQ(near->source_line, near_whole->source_line);
  ASSERT_EQ(read.warnings.size(), whole.warnings.size());
  for (std::size_t i = 0; i < read.warnings.size(); ++i) {
    EXPECT_EQ(to_string(read.warnings[i]), to_string(whole.warnings[i]));
  }
}

TEST(TravelAsRead, IsBitForBitThatOfTheWholeProgram) {
  const auto machine = machine_of("three-axis.toml");
  const auto piece = piece_of(wave(40'000));
  kinematics::GeometricErrors errors;
  errors[kinematics::AxisLetter::Y].location[5] = 3e-5;
  ASSERT_TRUE(may_travel_as_read(machine, errors, piece, as_read()));
  for (const bool limits : {false, true}) {
    auto options = as_a_whole();
    options.time_law.limits = limits;
    const auto whole = run_trial(machine, errors, piece, {}, options);
    ASSERT_TRUE(whole) << to_string(whole.error().front());
    for (const std::size_t threads : {1U, 2U, 8U}) {
      const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
      options = as_read();
      options.time_law.limits = limits;
      const auto read = run_trial(machine, errors, piece, {}, options);
      ASSERT_TRUE(read) << to_string(read.error().front());
      expect_same(*read, *whole);
    }
  }
}

// What is wrong comes first by the kind of fault, as it does of the whole program.
TEST(TravelAsRead, NamesTheSameFaultsAsTheWholeProgram) {
  const auto machine = machine_of("three-axis.toml");
  const std::string over_travel = "G0 X30000\n", unknown_word = "G1 X0 U5 F100\n",
                    no_block = "G1 X[ F100\n";
  for (const std::string& end :
       {over_travel, unknown_word, no_block, over_travel + unknown_word, over_travel + no_block,
        unknown_word + no_block, over_travel + "M30\n" + no_block, std::string("O7 call\nM30\n")}) {
    const auto piece = piece_of(wave(100, end));
    const auto read = run_trial(machine, kinematics::GeometricErrors{}, piece, {}, as_read());
    const auto whole = run_trial(machine, kinematics::GeometricErrors{}, piece, {}, as_a_whole());
    ASSERT_FALSE(whole) << end;
    ASSERT_FALSE(read) << end;
    ASSERT_EQ(read.error().size(), whole.error().size()) << end;
    for (std::size_t i = 0; i < whole.error().size(); ++i) {
      EXPECT_EQ(to_string(read.error()[i]), to_string(whole.error()[i]));
    }
  }
}

TEST(TravelAsRead, IsNotForWhatTheWholeProgramIsNeededFor) {
  const auto machine = machine_of("three-axis.toml");
  const kinematics::GeometricErrors none;
  auto piece = piece_of(wave(10));
  EXPECT_TRUE(may_travel_as_read(machine, none, piece, as_read()));
  EXPECT_FALSE(may_travel_as_read(machine, none, piece, as_a_whole()));
  auto errors = none;
  errors[kinematics::AxisLetter::X].component[0] = kinematics::ErrorFunction(
      std::vector<kinematics::ErrorTerm>{kinematics::ReversalTerm{0.004}});
  EXPECT_FALSE(may_travel_as_read(machine, errors, piece, as_read()));
  piece.operations.push_back({.name = "rows", .first_line = 7, .last_line = 12});
  EXPECT_FALSE(may_travel_as_read(machine, none, piece, as_read()));
}

}  // namespace
}  // namespace frustum::trials
