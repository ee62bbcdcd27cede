// The feed of the tip that the player shows, of motions that are shorter than its places are exact.
#include "app/player/played_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "app/player/played_program.hpp"

namespace frustum::app {
namespace {

PlayedPath path_of(const std::string& program, const PointBudget& budget = {}) {
  const auto file = std::filesystem::path(testing::TempDir()) / "played_path_test.nc";
  std::ofstream(file) << "G21 G90 G17\nT1 M6\nS1000 M3\nG54 G43 H1\nG0 X0 Y0 Z50\n"
                      << program << "M30\n";
  PlayerWords words{.file = file.string(), .dialect = "fanuc"};
  words.setup.machine = "three-axis";
  words.setup.tool_lengths = {"1=100"};
  const auto played = played_program(words);
  EXPECT_TRUE(played) << (played ? "" : to_string(played.error().front()));
  const auto commanded = trials::command_piece(played->job.machine, played->job.piece);
  EXPECT_TRUE(commanded);
  auto path = played_path(played->job, *commanded, {}, budget);
  EXPECT_TRUE(path);
  std::filesystem::remove(file);
  return *std::move(path);
}

// Never above it, and at it but where the axes speed up or slow down.
void expect_feed(const PlayedPath& path, double feed, std::size_t least_points) {
  std::size_t count = 0;
  for (const PathPoint& point : path.points) {
    if (point.starts || path.blocks[point.block].kind == kinematics::PathKind::rapid) continue;
    EXPECT_LT(point.feed, feed + 1e-3) << "at " << point.time;
    if (point.feed > feed - 1e-3) ++count;
  }
  EXPECT_GE(count, least_points);
}

// A circle of 0.5 mm in 2000 steps of 1.6 um: ten steps of the page's places, 190 of its times.
std::string fine_circle() {
  std::string text = "G1 F500\n";
  for (int k = 1; k <= 2000; ++k) {
    const double turn = 2.0 * 3.14159265358979 * k / 2000.0;
    text += "X" + std::to_string(0.5 * (1.0 - std::cos(turn))) + " Y" +
            std::to_string(0.5 * std::sin(turn)) + "\n";
  }
  return text;
}

TEST(PlayedPath, FeedsOfShortMotionsAreAsProgrammed) {
  expect_feed(path_of(fine_circle()), 500.0, 1000);
}

// What is left out between two points counts with its way, not with its chord.
TEST(PlayedPath, FeedsOfThinnedPathsAreAsProgrammed) {
  const PlayedPath path = path_of(fine_circle(), {.most = 150});
  EXPECT_GT(path.left_out, 1000U);
  expect_feed(path, 500.0, 20);
}

}  // namespace
}  // namespace frustum::app
