#include "parser/interpreter.hpp"

#include <gtest/gtest.h>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

AxisTarget target(std::initializer_list<std::pair<AxisLetter, double>> axes) {
  AxisTarget target;
  for (const auto& [axis, value] : axes) target[axis] = value;
  return target;
}

ModalState state_after(std::string_view text) {
  const auto program = parse_program(text, "part.nc");
  EXPECT_TRUE(program);
  const auto summary = interpret(*program, [](Motion&&) {});
  EXPECT_TRUE(summary);
  return summary ? summary->state : ModalState{};
}

// Complaint 11: a phantom gouge at the start comes from a start state nobody defined.
TEST(Complaint11, StartsWithNoPositionNoMotionAndNoTool) {
  const ModalState start = state_after("");
  EXPECT_EQ(start.motion, MotionMode::none);
  EXPECT_EQ(start.plane, Plane::xy);
  EXPECT_EQ(start.unit, LengthUnit::millimetre);
  EXPECT_EQ(start.distance, DistanceMode::absolute);
  EXPECT_EQ(start.feed_mode, FeedMode::per_minute);
  EXPECT_FALSE(start.feed.has_value());
  EXPECT_FALSE(start.selected_tool.has_value());
  EXPECT_EQ(start.spindle, SpindleDirection::off);
  EXPECT_EQ(start.work_offset, 1);
  EXPECT_EQ(start.compensation.mode(), LengthCompensation::off);
}

TEST(Complaint11, TheFirstMoveNamesOnlyTheAxesTheProgramGave) {
  const auto moves = all_of<Traverse>(motions("G0 Z50\nX1 Y2\n"));
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[0].end, target({{Z, 50}}));
  EXPECT_EQ(moves[1].end, target({{X, 1}, {Y, 2}, {Z, 50}}));
}

TEST(Interpreter, KeepsMotionAxesAndFeed) {
  const auto moves = all_of<LinearFeed>(motions("G1 X1 Y2 F300\nX3\nG0 Z5\nG1 Y4\n"));
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_EQ(moves[1].end, target({{X, 3}, {Y, 2}}));
  EXPECT_EQ(moves[2].end, target({{X, 3}, {Y, 4}, {Z, 5}}));
  EXPECT_EQ(moves[2].feed.value, 300.0);
}

TEST(Interpreter, SetsTheMotionWithoutAxisWordsAndDoesNotMove) {
  EXPECT_TRUE(motions("G1\nG0\nG2\n").empty());
  EXPECT_EQ(all_of<LinearFeed>(motions("G1\nF100\nX5\n")).size(), 1U);
}

TEST(Interpreter, AddsIncrementsToWhereTheAxisIs) {
  const auto moves = all_of<Traverse>(motions("G0 X10 Y5 A30\nG91 X-2 A10\nX-2\nG90 X1\n"));
  ASSERT_EQ(moves.size(), 4U);
  EXPECT_EQ(moves[2].end[X], 6.0);
  EXPECT_DOUBLE_EQ(*moves[2].end[A], 40 * kRadPerDeg);
  EXPECT_EQ(moves[3].end[X], 1.0);
}

// Complaint 18: inches scale lengths and never angles.
TEST(Complaint18, InchScalesLengthsAndFeedButNeverRotaryAxes) {
  const auto move = last_of<LinearFeed>(motions("G20 G1 X1 Y-2 Z0.5 A10 B20 C30 F10\n"));
  EXPECT_EQ(move.end[X], 25.4);
  EXPECT_EQ(move.end[Y], -50.8);
  EXPECT_EQ(move.end[Z], 12.7);
  EXPECT_EQ(move.end[A], 10 * kRadPerDeg);
  EXPECT_EQ(move.end[B], 20 * kRadPerDeg);
  EXPECT_EQ(move.end[C], 30 * kRadPerDeg);
  EXPECT_EQ(move.feed.value, 254.0);
}

TEST(Complaint18, InchScalesCentresAndRadii) {
  const auto by_centre = last_of<ArcFeed>(motions("G20 G0 X0 Y0 Z0\nG2 X2 I1 J0 F1\n"));
  EXPECT_EQ(by_centre.center, Vec3(25.4, 0, 0));
  const auto by_radius = last_of<ArcFeed>(motions("G20 G0 X0 Y0 Z0\nG2 X2 R1 F1\n"));
  EXPECT_LT((by_radius.center - Vec3(25.4, 0, 0)).norm(), 1e-6);
}

TEST(Complaint18, InchNeverScalesToolVectors) {
  const auto moves = motions("G20 G43.5 H1\nG0 X1 Y0 Z0 I0.6 J0 K0.8\n");
  const auto move = last_of<Traverse>(moves);
  ASSERT_TRUE(move.tool_axis.has_value());
  EXPECT_LT((move.tool_axis->vec() - Vec3(0.6, 0, 0.8)).norm(), 1e-15);
}

TEST(Complaint18, FeedOfARotaryMoveIsDegreesPerMinuteInInchesToo) {
  const auto moves = all_of<LinearFeed>(motions("G20 G0 X1 C0\nG1 C90 F360\nX2\nX2 C0\n"));
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_EQ(moves[0].feed.value, 360.0);
  EXPECT_EQ(moves[1].feed.value, 360.0 * 25.4);
  EXPECT_EQ(moves[2].feed.value, 360.0);
}

TEST(Complaint18, UnitsOfABlockCountForAllItsWordsAndLeaveThePositionAlone) {
  const auto moves = all_of<Traverse>(motions("G0 X1 G20\nG21 Y1\nG91 G20 X1\n"));
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_EQ(moves[0].end, target({{X, 25.4}}));
  EXPECT_EQ(moves[1].end, target({{X, 25.4}, {Y, 1}}));
  EXPECT_EQ(moves[2].end[X], 50.8);
}

// Complaint 21: a rotation drawn as a straight line begins with a rotary word read as a length.
TEST(Complaint21, RotaryWordsAreAngles) {
  const auto move = last_of<Traverse>(motions("G0 A90 B-45 C360.5\n"));
  EXPECT_EQ(move.end,
            target({{A, 90 * kRadPerDeg}, {B, -45 * kRadPerDeg}, {C, 360.5 * kRadPerDeg}}));
}

TEST(Interpreter, ReadsInverseTimeFeedPerBlock) {
  const auto moves = all_of<LinearFeed>(motions("G93 G20\nG1 X1 F2\nX2 F4\nG94 X3 F10\n"));
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_EQ(moves[1].feed.mode, FeedMode::inverse_time);
  EXPECT_EQ(moves[1].feed.value, 4.0);
  EXPECT_EQ(moves[2].feed.mode, FeedMode::per_minute);
  EXPECT_EQ(moves[2].feed.value, 254.0);
}

TEST(Interpreter, DwellsInMillisecondsOrSeconds) {
  const auto dwells =
      all_of<Dwell>(motions("G4 P1500\nG4 P0.5\nG4 P2.\nG4 X1.5\nG4 U2\n#1=250\nG4 P#1\n"));
  std::vector<double> seconds;
  for (const Dwell& dwell : dwells) seconds.push_back(dwell.seconds);
  EXPECT_EQ(seconds, (std::vector<double>{1.5, 0.5, 2.0, 1.5, 2.0, 0.25}));
}

TEST(Interpreter, DwellDoesNotMoveTheAxisItsTimeIsNamedAfter) {
  const auto moves = all_of<Traverse>(motions("G0 X5 Y5\nG4 X2\nY6\n"));
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[1].end, target({{X, 5}, {Y, 6}}));
}

TEST(Interpreter, ChangesToolsInOneBlockOrTwo) {
  std::vector<int> tools;
  for (const ToolChange& change : all_of<ToolChange>(motions("T1 M6\nM6 T2\nT3\nT4\nM6\nM6\n"))) {
    tools.push_back(change.tool);
  }
  EXPECT_EQ(tools, (std::vector<int>{1, 2, 4, 4}));
}

TEST(Interpreter, StopsTheSpindleForAToolChange) {
  const auto changes = all_of<SpindleChange>(motions("S500 M3\nT1 M6\nM4\nS600\nM5\nS700\n"));
  ASSERT_EQ(changes.size(), 5U);
  EXPECT_EQ(changes[1].direction, SpindleDirection::off);
  EXPECT_EQ(changes[2].direction, SpindleDirection::counterclockwise);
  EXPECT_EQ(changes[2].speed, 500.0);
  EXPECT_EQ(changes[3].speed, 600.0);
  EXPECT_EQ(changes[4].direction, SpindleDirection::off);
}

TEST(Interpreter, OrdersTheWordsOfABlockAsRs274Does) {
  const auto all = motions("G1 X5 F100 M8 M3 S100 T1 M6 G54 G43 H1 M0 (first)\n");
  std::vector<std::size_t> kinds;
  for (const Motion& motion : all) kinds.push_back(motion.command.index());
  const std::vector<std::size_t> expected{Command(Event{}).index(),
                                          Command(ToolChange{}).index(),
                                          Command(SpindleChange{}).index(),
                                          Command(CoolantChange{}).index(),
                                          Command(CompensationChange{}).index(),
                                          Command(WorkOffsetChange{}).index(),
                                          Command(LinearFeed{}).index(),
                                          Command(Stop{}).index()};
  EXPECT_EQ(kinds, expected);
}

TEST(Interpreter, EndsAtM30AndM2AndRunsOnAfterM0AndM1) {
  EXPECT_EQ(all_of<Traverse>(motions("G0 X1\nM30\nX2\n")).size(), 1U);
  EXPECT_EQ(all_of<Traverse>(motions("G0 X1\nM2\nX2\n")).size(), 1U);
  EXPECT_EQ(all_of<Traverse>(motions("G0 X1\nM0\nX2\nM1\nX3\n")).size(), 3U);
}

TEST(Interpreter, SaysWhereEachMotionStands) {
  const auto all = motions("N10 G1 X5 F100\nN20 Y5 X6\n\nN30 (note) M8\n");
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].place.line, 1U);
  EXPECT_EQ(all[0].place.column, 5U);
  EXPECT_EQ(all[1].place.line, 2U);
  EXPECT_EQ(all[1].place.column, 5U);
  EXPECT_EQ(all[2].place.column, 5U);
  EXPECT_EQ(all[3].place.line, 4U);
  EXPECT_EQ(all[3].place.column, 12U);
}

TEST(Interpreter, ReportsCommentsAndMessages) {
  const auto events = all_of<Event>(motions("(plain)\n( msg, Turn the part )\n; rest\n"));
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[0].name + "|" + events[0].text, "comment|plain");
  EXPECT_EQ(events[1].name + "|" + events[1].text, "message|Turn the part ");
  EXPECT_EQ(events[2].name + "|" + events[2].text, "comment| rest");
}

TEST(Interpreter, LeavesOutDeletableBlocksOnlyWhenAsked) {
  const char* text = "G0 X1\n/X2\n/Q\nX3\n";
  EXPECT_EQ(complaints(text).size(), 1U);  // a deletable block is still read
  EXPECT_EQ(all_of<Traverse>(motions("G0 X1\n/X2\nX3\n")).size(), 3U);
  const auto all = motions("G0 X1\n/X2 P9\nX3\n", {.block_delete = true});
  EXPECT_EQ(all_of<Traverse>(all).size(), 2U);
  EXPECT_EQ(all_of<Event>(all).at(0).name, "block_delete");
}

TEST(Interpreter, AcceptsTheSafeLineOfPostProcessors) {
  EXPECT_TRUE(complaints("%\nO1000 (PART)\nG00 G17 G21 G40 G49 G80 G90 G94 G54\nG69 G15 G50 G67\n"
                         "G91 G28 Z0.\nG90\nT01 M06\nG00 X0. Y0. S8000 M03\nG43 Z50. H01\nM08\n"
                         "G01 Z-1. F500.\nM09\nM05\nG53 G00 Z0.\nG00 G91 G28 Y0.\nM30\n%\n")
                  .empty());
}

// In LinuxCNC G80 ends any motion; Fanuc has cycles in a group of their own.
TEST(Interpreter, CancelsTheMotionOrTheCycleByG80) {
  EXPECT_EQ(complaints("G0 X1\nG80\nX5\n", {}, Dialect::linuxcnc).size(), 1U);
  EXPECT_EQ(state_after("G1\nG80\n").motion, MotionMode::linear);
  EXPECT_EQ(state_after("G80 G0\n").motion, MotionMode::traverse);
  const char* holes = "G0 X0 Y0 Z10\nS1 M3\nG81 X1 Z-1 R1 F10\nG80\nX8\n";
  EXPECT_EQ(last_of<Traverse>(motions(holes)).end[AxisLetter::X], 8.0);
}

TEST(Interpreter, ReadsEveryWorkOffset) {
  std::vector<int> numbers;
  for (const auto& change : all_of<WorkOffsetChange>(motions("G54\nG55\nG56\nG57\nG58\nG59\n"))) {
    numbers.push_back(change.number);
  }
  EXPECT_EQ(numbers, (std::vector<int>{1, 2, 3, 4, 5, 6}));
}

// A loop that computes on and on without a motion is reported long before the limit of all blocks.
TEST(Interpreter, TellsALoopThatDoesNotEnd) {
  const char* loop = "G0 X0\n#1=0\nWHILE[#1 LT 900]DO1\n#1=#1+1\nEND1\nG0 X1\n";
  InterpreterOptions options;
  options.max_idle_blocks = 1000;
  const auto told = complaints(loop, options);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("more than 1000 blocks have run without a motion"), std::string::npos);
  options.max_idle_blocks = 3000;
  EXPECT_TRUE(complaints(loop, options).empty());
}

TEST(Interpreter, TellsALoopThatMovesWithoutEnd) {
  InterpreterOptions options;
  options.control.max_blocks = 5000;
  const char* loop = "G91 G0 X0 Y0\nN1 X1\nGOTO 1\n";
  const auto told = complaints(loop, options);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("more than 5000 blocks have run again"), std::string::npos) << told[0];
  // The lines of the file are no repeats.
  std::string straight = "G0 X0\n";
  for (int i = 0; i < 9000; ++i) straight += "X1\n";
  EXPECT_TRUE(complaints(straight, options).empty());
}

// Dwells, stops and remarks are no way out of a loop.
TEST(Interpreter, TellsALoopThatOnlyWaits) {
  InterpreterOptions options;
  options.max_idle_blocks = 1000;
  const auto told = complaints("G0 X0\nWHILE[1 EQ 1]DO1\nG4 X1.\nM0\nEND1\n", options);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_NE(told[0].find("more than 1000 blocks have run without a motion"), std::string::npos);
}

TEST(Interpreter, CountsTheBlocksItRan) {
  const auto program = parse_program("%\nG0 X1\n\nX2\nM30\nX3\n%\n", "part.nc");
  ASSERT_TRUE(program);
  EXPECT_EQ(interpret(*program, [](Motion&&) {})->blocks, 4U);
}

}  // namespace
}  // namespace frustum::parser
