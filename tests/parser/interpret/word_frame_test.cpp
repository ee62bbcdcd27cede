#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

TEST(WordFrame, TurnsWordsAboutItsCentre) {
  const auto moves =
      all_of<Traverse>(motions("G0 X0 Y0 Z5\nG68 X10 Y0 R90\nX20 Y0 Z5\nG69\nX1 Y2\n"));
  ASSERT_EQ(moves.size(), 3U);
  // 10 mm to the right of the centre becomes 10 mm above it.
  EXPECT_NEAR(*moves[1].end[X], 10.0, 1e-12);
  EXPECT_NEAR(*moves[1].end[Y], 10.0, 1e-12);
  EXPECT_NEAR(*moves[1].end[Z], 5.0, 1e-12);
  EXPECT_NEAR(*moves[2].end[X], 1.0, 1e-12);
  EXPECT_NEAR(*moves[2].end[Y], 2.0, 1e-12);
}

TEST(WordFrame, KeepsTheToolWhereItIs) {
  // Incremental moves go along the turned axes, from where the tool stands.
  const auto moves =
      all_of<LinearFeed>(motions("G0 X30 Y40 Z5\nG68 X7 Y-2 R33\nG91 G1 X0 Y0 Z0 F100\nX10\n"));
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_NEAR(*moves[0].end[X], 30.0, 1e-12);
  EXPECT_NEAR(*moves[0].end[Y], 40.0, 1e-12);
  const double angle = 33.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR(*moves[1].end[X], 30.0 + 10.0 * std::cos(angle), 1e-12);
  EXPECT_NEAR(*moves[1].end[Y], 40.0 + 10.0 * std::sin(angle), 1e-12);
}

TEST(WordFrame, TurnsTheCentresOfArcs) {
  const auto arc =
      last_of<ArcFeed>(motions("G0 X10 Y0 Z5\nG68 X0 Y0 R90\nG0 X10 Y0 Z5\nG3 X0 Y10 I-10 F100\n"));
  EXPECT_NEAR(arc.center[0], 0.0, 1e-12);
  EXPECT_NEAR(arc.center[1], 0.0, 1e-12);
  EXPECT_NEAR(*arc.end[X], -10.0, 1e-12);
  EXPECT_NEAR(*arc.end[Y], 0.0, 1e-12);
  EXPECT_EQ(arc.turns, 1);
}

TEST(WordFrame, CutsArcsInAPlaneThatItTurnsIntoChords) {
  const auto lines = all_of<LinearFeed>(
      motions("G0 X0 Y0 Z0\nROT Z30\nG18 G2 X10 Z0 I5 K0 F100\nM30\n", {}, Dialect::sinumerik));
  ASSERT_GT(lines.size(), 100U);
  const double angle = 30.0 * std::numbers::pi / 180.0;
  for (const LinearFeed& line : lines) {
    const double along = *line.end[X] * std::cos(angle) + *line.end[Y] * std::sin(angle);
    EXPECT_NEAR(std::hypot(along - 5.0, *line.end[Z]), 5.0, 1e-9);
  }
  EXPECT_NEAR(*lines.back().end[X], 10.0 * std::cos(angle), 1e-12);
}

TEST(WordFrame, NeedsTheAxesItTurnsBeforeAMove) {
  const auto lines = complaints("G0 X0\nG68 X0 Y0 R30\nG0 X10\n");
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("a move in a turned frame, but"), std::string::npos) << lines[0];
}

TEST(WordFrame, ShiftsRotaryAxesAlone) {
  const auto moves = all_of<Traverse>(motions("G0 X1 A30\nG92 X0 A0\nX5 A10\n"));
  EXPECT_NEAR(*moves[1].end[X], 6.0, 1e-12);
  EXPECT_NEAR(*moves[1].end[A] * 180.0 / std::numbers::pi, 40.0, 1e-12);
}

}  // namespace
}  // namespace frustum::parser
