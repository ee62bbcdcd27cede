#include <gtest/gtest.h>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

TEST(ToolCentrePoint, IsSwitchedWithItsOffsetNumber) {
  const auto changes =
      all_of<CompensationChange>(motions("G43 H3\nG43.4 H4\nG43.5 H5\nG49\nG43\n"));
  ASSERT_EQ(changes.size(), 5U);
  EXPECT_EQ(changes[0].mode, LengthCompensation::length);
  EXPECT_EQ(changes[0].offset_number, 3);
  EXPECT_EQ(changes[1].mode, LengthCompensation::tool_centre_point);
  EXPECT_FALSE(changes[1].tool_vectors);
  EXPECT_EQ(changes[1].offset_number, 4);
  EXPECT_EQ(changes[2].mode, LengthCompensation::tool_centre_point);
  EXPECT_TRUE(changes[2].tool_vectors);
  EXPECT_EQ(changes[3].mode, LengthCompensation::off);
  EXPECT_EQ(changes[4].offset_number, 5);  // H stays in force
}

TEST(ToolCentrePoint, TakesEffectBeforeTheMoveOfItsBlock) {
  const auto all = motions("G43.5 H1 G0 X1 Y2 Z3 I0 J0 K1\n");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<CompensationChange>(all[0].command));
  EXPECT_TRUE(std::get<Traverse>(all[1].command).tool_axis.has_value());
}

TEST(ToolCentrePoint, NormalisesTheToolVector) {
  const auto move = last_of<Traverse>(motions("G43.5 H1\nG0 X0 Y0 Z0 I3 J0 K4\n"));
  ASSERT_TRUE(move.tool_axis.has_value());
  EXPECT_LT((move.tool_axis->vec() - Vec3(0.6, 0, 0.8)).norm(), 1e-15);
}

TEST(ToolCentrePoint, TakesMissingVectorWordsAsZero) {
  const auto move = last_of<Traverse>(motions("G43.5 H1\nG0 X0 Y0 Z0 K2\n"));
  EXPECT_EQ(move.tool_axis->vec(), Vec3(0, 0, 1));
}

TEST(ToolCentrePoint, KeepsTheToolVectorUntilAnother) {
  const auto moves =
      all_of<LinearFeed>(motions("G43.5 H1\nG1 X0 Y0 Z0 I1 J0 K0 F100\nX1\nI0 J1 K0\nG49\nX2\n"));
  ASSERT_EQ(moves.size(), 4U);
  EXPECT_EQ(moves[1].tool_axis->vec(), Vec3(1, 0, 0));
  EXPECT_EQ(moves[2].tool_axis->vec(), Vec3(0, 1, 0));
  EXPECT_FALSE(moves[3].tool_axis.has_value());
}

TEST(ToolCentrePoint, TakesVectorsAndRotaryWordsByTurns) {
  const auto moves =
      all_of<Traverse>(motions("G43.4 H1\nG0 X0 Y0 Z0 A10 C20\nG43.5 H1 I1 J0 K1\nX1\n"
                               "G43.4 H1 A5 C6\nX2\n"));
  ASSERT_EQ(moves.size(), 5U);
  EXPECT_FALSE(moves[0].tool_axis.has_value());
  EXPECT_EQ(moves[0].end[A], 10 * kRadPerDeg);
  // The vector moved the rotary axes to where only the machine knows.
  EXPECT_TRUE(moves[1].tool_axis.has_value());
  EXPECT_FALSE(moves[1].end[A].has_value());
  EXPECT_FALSE(moves[2].end[C].has_value());
  EXPECT_TRUE(moves[2].tool_axis.has_value());
  // A rotary word takes over again.
  EXPECT_FALSE(moves[3].tool_axis.has_value());
  EXPECT_EQ(moves[4].end[C], 6 * kRadPerDeg);
}

TEST(ToolCentrePoint, IsNotMovedByIncrementalModeInItsVectors) {
  const auto moves = all_of<Traverse>(motions("G43.5 H1\nG0 X0 Y0 Z0 K1\nG91 X1 I1 J0 K0\n"));
  EXPECT_EQ(moves.back().tool_axis->vec(), Vec3(1, 0, 0));
}

TEST(ToolCentrePoint, ReadsCentresNotVectorsOnArcs) {
  const auto arc =
      last_of<ArcFeed>(motions("G43.5 H1\nG0 X10 Y0 Z5 I0 J1 K1\nG3 X-10 I-10 J0 F100\n"));
  EXPECT_EQ(arc.center, Vec3(0, 0, 5));
  ASSERT_TRUE(arc.tool_axis.has_value());
  EXPECT_GT(arc.tool_axis->vec().y(), 0.7);
}

TEST(ToolCentrePoint, TurnsTheToolInPlaceWithARotaryFeed) {
  const auto moves =
      all_of<LinearFeed>(motions("G20 G43.5 H1\nG0 X1 Y1 Z1 K1\nG1 I1 K1 F360\nX2\n"));
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[0].feed.value, 360.0);
  EXPECT_EQ(moves[1].feed.value, 360.0 * 25.4);
}

}  // namespace
}  // namespace frustum::parser
