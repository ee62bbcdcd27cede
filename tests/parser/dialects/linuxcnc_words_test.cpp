// Words and rules of LinuxCNC that programs of the world need, each as the control has it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.hpp"
#include "parser/dialect.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run_linuxcnc(std::string_view text, const InterpreterOptions& options = {}) {
  return motions(text, options, Dialect::linuxcnc);
}

std::vector<std::string> linuxcnc_ids(std::string_view text,
                                      const InterpreterOptions& options = {}) {
  return complaint_ids(text, options, Dialect::linuxcnc);
}

using Ids = std::vector<std::string>;

InterpreterOptions mill_and_lathe_tool() {
  InterpreterOptions options;
  options.tools[7] = Tool{.offset = {0, 0, 70, 0, 0, 0}, .diameter = 4.0};
  options.tools[8] = Tool{.offset = {0, 0, 80, 0, 0, 0}, .diameter = 4.0, .orientation = 3};
  return options;
}

// The end of the last rapid move.
std::vector<double> linuxcnc_place(std::string_view text) {
  const auto move = last_of<Traverse>(run_linuxcnc(text));
  return {move.end[X].value_or(-1.0), move.end[Y].value_or(-1.0)};
}

TEST(LinuxCncWords, Fault2_03_RadiiOfAnArcMayDifferAsTheControlAllows) {
  EXPECT_EQ(linuxcnc_ids("G0 X1.8 Y0 Z0\nG2 X0 Y1.787 I-1.8 J0 F100\n"), Ids{});
  EXPECT_EQ(linuxcnc_ids("G0 X1.8 Y0 Z0\nG2 X0 Y1.77 I-1.8 J0 F100\n"), Ids{"arc-radius"});
  EXPECT_EQ(linuxcnc_ids("G20 G0 X1.8 Y0 Z0\nG2 X0 Y1.7973 I-1.8 J0 F100\n"), Ids{});
  EXPECT_EQ(linuxcnc_ids("G20 G0 X1.8 Y0 Z0\nG2 X0 Y1.797 I-1.8 J0 F100\n"), Ids{"arc-radius"});
  // 0.1 % of the radius, up to a hundred times as much.
  EXPECT_EQ(linuxcnc_ids("G0 X1000 Y0 Z0\nG2 X0 Y999.1 I-1000 J0 F100\n"), Ids{});
  EXPECT_EQ(linuxcnc_ids("G0 X1000 Y0 Z0\nG2 X0 Y998.9 I-1000 J0 F100\n"), Ids{"arc-radius"});
  EXPECT_EQ(linuxcnc_ids("G0 X9000 Y0 Z0\nG2 X0 Y8997 I-9000 J0 F100\n"), Ids{"arc-radius"});
  // R may be a little too small.
  EXPECT_EQ(linuxcnc_ids("G0 X0 Y0 Z0\nG2 X2 R0.9988 F100\n"), Ids{});
  EXPECT_EQ(linuxcnc_ids("G0 X0 Y0 Z0\nG2 X2 R0.9987 F100\n"), Ids{"arc-radius"});
}

TEST(LinuxCncWords, FeedModesEndTheFeedAlsoOfTheSameMode) {
  EXPECT_EQ(linuxcnc_ids("F100\nG94 G1 X5\n"), Ids{"feed-missing"});
  EXPECT_EQ(linuxcnc_ids("G95 G1 X5 F.1\nG95 X6\n"), Ids{"feed-missing"});
  EXPECT_EQ(linuxcnc_ids("F50\nG94 G1 X5 F100\n"), Ids{});
}

TEST(LinuxCncWords, HolesAreReachedAboveTheToolAndTheInitialLevel) {
  // The second cycle leaves at Z6, above the Z5 of the third one's beginning.
  const auto rapids = all_of<Traverse>(run_linuxcnc(
      "G0 X0 Y0 Z5\nF100 G98 G81 X2 Z-1 R2\nG91 G81 X1 Z-1 R1\nG90 G82 X4 Z-1 R1 P0\nG80\n"));
  double last = 0.0;
  for (const Traverse& rapid : rapids) {
    if (rapid.end[X] == 4.0) {
      EXPECT_EQ(rapid.end[Z], last);
      break;
    }
    last = rapid.end[Z].value_or(-1.0);
  }
}

TEST(LinuxCncWords, Fault2_04_H0AndD0AreTheToolInTheSpindle) {
  const auto changes =
      all_of<CompensationChange>(run_linuxcnc("T7 M6\nG43 H0\nG43 H8\n", mill_and_lathe_tool()));
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].length, 70.0);
  EXPECT_EQ(changes[1].length, 80.0);
  const auto moves = all_of<LinearFeed>(run_linuxcnc(
      "T7 M6\nG0 X0 Y0 Z0\nG41 D0 G1 X20 F100\nY20\nG40 X0\nM2\n", mill_and_lathe_tool()));
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_DOUBLE_EQ(*moves[0].end[X], 18.0);
  // No tool has no diameter: the contour itself.
  const auto bare =
      all_of<LinearFeed>(run_linuxcnc("G0 X0 Y0 Z0\nG41 D0 G1 X20 F100\nY20\nG40 X0\nM2\n"));
  EXPECT_EQ(bare[0].end[X], 20.0);
  EXPECT_EQ(bare[1].end[Y], 20.0);
}

TEST(LinuxCncWords, Fault2_04_ADiameterMayBeZeroOrNegative) {
  constexpr std::string_view kSquare = "G1 X10 F100\nY10\nX0\nG40 Y0\nM2\n";
  const auto square = [&](const std::string& word) {
    return all_of<LinearFeed>(run_linuxcnc("G0 X0 Y0 Z0\n" + word + "\n" + std::string(kSquare)));
  };
  EXPECT_EQ(square("G41.1 D0")[0].end[Y], 0.0);
  EXPECT_EQ(square("G41.1 D0").size(), 4U);
  EXPECT_EQ(square("G41.1 D-2")[0].end[Y], -1.0);
  EXPECT_EQ(square("G42.1 D2")[0].end[Y], -1.0);
  EXPECT_EQ(linuxcnc_ids("T7 M6\nG41 D-2\n"), Ids{"out-of-range"});
}

TEST(LinuxCncWords, Fault2_04_AnAngleAloneKeepsTheRadius) {
  const auto turned = linuxcnc_place("G90\nG0 X3 Y4\n^60\n");
  EXPECT_NEAR(turned[0], 2.5, 1e-12);
  EXPECT_NEAR(turned[1], 4.330127018922193, 1e-12);
  const auto holes =
      all_of<LinearFeed>(run_linuxcnc("G0 X2 Y0 Z1\nG81 R0.5 Z-1 F100\n^90\n@1 ^180\nM2\n"));
  ASSERT_EQ(holes.size(), 3U);
  EXPECT_NEAR(*holes[1].end[Y], 2.0, 1e-12);
  EXPECT_NEAR(*holes[2].end[X], -1.0, 1e-12);
}

TEST(LinuxCncWords, Fault2_04_ParametersAreFoundByComputedNumbers) {
  EXPECT_EQ(linuxcnc_place("#1=2\n##1=7\nG0 X#2 Y##1\n"), (std::vector{7.0, 7.0}));
  EXPECT_EQ(linuxcnc_place("#atan[1]/[1]=3\nG0 X#45 Y#fix[45.7]\n"), (std::vector{3.0, 3.0}));
  EXPECT_EQ(linuxcnc_place("#1=99999\nG0 X EXISTS[#1] Y EXISTS[##1]\n"), (std::vector{1.0, 0.0}));
  EXPECT_EQ(linuxcnc_place("#1=2\nG0 XEXISTS[##1] YEXISTS[#<a>]\n"), (std::vector{1.0, 0.0}));
}

TEST(LinuxCncWords, Fault2_04_OWordsMayHaveCommentsTitlesAndNoBeginning) {
  EXPECT_EQ(linuxcnc_place("o1 sub\nG0 X#1 Y#2\no1 endsub\no1 call [1] (c) [2]\nM2\n"),
            (std::vector{1.0, 2.0}));
  EXPECT_EQ(linuxcnc_place("G0 X#<_value> Y#<_value_returned>\n"), (std::vector{0.0, 0.0}));
  EXPECT_EQ(linuxcnc_place("N4567.789 G0 X1 Y2\n"), (std::vector{1.0, 2.0}));
  EXPECT_EQ(linuxcnc_place("o2 sub\nG0 X8\no2 endsub\nO1 (main)\nG0 Y1\no2 call\n%\n"),
            (std::vector{8.0, 1.0}));
  EXPECT_EQ(linuxcnc_place("G0 X1\nO1\nG0 Y2\nM2\n"), (std::vector{1.0, 2.0}));
  EXPECT_EQ(linuxcnc_place("O<Plate> (a title)\nG0 X1 Y2\nM2\n"), (std::vector{1.0, 2.0}));
}

// A block that the program never runs into is no mistake.
TEST(LinuxCncWords, StatementsThatDoNotBelongTogetherCountWhereTheyAreRun) {
  EXPECT_EQ(linuxcnc_ids("o1 sub\no2 if [1]\nG0 X1\no1 endsub\nG0 X2\nM2\n"), Ids{});
  EXPECT_EQ(linuxcnc_ids("o1 sub\no2 if [1]\nG0 X1\no1 endsub\no1 call\nM2\n"),
            Ids{"flow-unpaired"});
}

TEST(LinuxCncWords, Fault2_05_SubprogramsAreNoPartOfThePath) {
  EXPECT_EQ(linuxcnc_ids("o1 call\no1 sub\nG0 X1\no1 endsub\nM2\n"), Ids{"subprogram-in-path"});
  EXPECT_EQ(linuxcnc_ids("%\no1 call\n%\no1 sub\nG0 X1\no1 endsub\n"), Ids{"missing-subprogram"});
  EXPECT_EQ(linuxcnc_ids("o1 call\nM2\no1 sub\nG0 X1\no1 endsub\n"), Ids{});
  EXPECT_EQ(linuxcnc_ids("o1 sub\nG0 X1\no1 endsub\no1 call\no1 call\nM2\n"), Ids{});
}

TEST(LinuxCncWords, Fault2_05_MotionsNeedAnEndAndAbortEnds) {
  EXPECT_EQ(linuxcnc_ids("G0 X0 Y0 Z0\nG38.2 F1\n"), Ids{"axes-missing"});
  EXPECT_EQ(linuxcnc_ids("G0 X0 Y0 Z0\nG81\n"), Ids{"axes-missing"});
  EXPECT_EQ(linuxcnc_ids("(abort, no tool)\nG0 X1\n"), Ids{"program-alarm"});
}

// The corner of an edge of radius 2, orientation 3, is 2 mm on in X and back in Z from its centre.
TEST(LinuxCncWords, Fault2_05_TheEdgeOfALatheToolHasItsControlPoint) {
  const auto moves = all_of<LinearFeed>(
      run_linuxcnc("G18 G0 X0 Y0 Z0\nG41.1 D4 L3 G1 X10 F100\nZ10\nG40 X0\nM2\n"));
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_DOUBLE_EQ(*moves[0].end[X], 12.0);
  EXPECT_DOUBLE_EQ(*moves[0].end[Z], -4.0);
  EXPECT_DOUBLE_EQ(*moves[1].end[X], 14.0);
  const auto listed = all_of<LinearFeed>(run_linuxcnc(
      "T8 M6\nG18 G0 X0 Y0 Z0\nG41 G1 X10 F100\nZ10\nG40 X0\nM2\n", mill_and_lathe_tool()));
  EXPECT_EQ(listed[0].end, moves[0].end);
  EXPECT_EQ(linuxcnc_ids("T8 M6\nG17 G0 X0 Y0 Z0\nG41 G1 X10 F100\n", mill_and_lathe_tool()),
            Ids{"radius-plane"});
}

TEST(LinuxCncWords, Fault2_14_TheTipControlWorksWithoutALength) {
  const auto changes =
      all_of<CompensationChange>(run_linuxcnc("G0 X0 Y0 Z0\nM428\nG1 X10 B30 F100\nM429\nM2\n"));
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].mode, LengthCompensation::tool_centre_point);
  EXPECT_EQ(changes[0].length, 0.0);
  EXPECT_EQ(changes[1].mode, LengthCompensation::off);
}

TEST(LinuxCncWords, Fault2_14_TheEndingOfTheNameComesBeforeWordsOfFanuc) {
  EXPECT_EQ(recognise_dialect("G68.2 P0 X0 Y0 Z0 I10 J0 K0\n", "part.ngc").dialect,
            Dialect::linuxcnc);
  EXPECT_EQ(recognise_dialect("G68.2 P0 X0 Y0 Z0 I10 J0 K0\n", "part.nc").dialect, Dialect::fanuc);
}

TEST(LinuxCncWords, Fault2_05_ADefinitionWithinAnotherIsAnErrorEvenUncalled) {
  EXPECT_EQ(linuxcnc_ids("o1 sub\no2 sub\no2 endsub\no1 endsub\nG0 X1\nM2\n"),
            Ids{"flow-unpaired"});
}

TEST(LinuxCncWords, M99OfTheMainProgramRunsItOnce) {
  const auto all = run_linuxcnc("G0 X5\nM99\n");
  EXPECT_EQ(all_of<Traverse>(all).size(), 1U);
  EXPECT_EQ(last_of<Event>(all).grade, EventGrade::assumed);
}

TEST(LinuxCncWords, TheMotionModeIsTenTimesItsWord) {
  EXPECT_EQ(linuxcnc_place("G0 X0 Y0 Z5\nG81 X1 Z-1 R1 F100\n#1=#<_motion_mode>\nG5.1 X2 I1 J1\n"
                           "#2=#<_motion_mode>\nG0 X#1 Y#2\n"),
            (std::vector{810.0, 51.0}));
}

TEST(LinuxCncWords, Fault2_15_AMoveOfNoLengthHasItsFeedInMillimetres) {
  const auto moves = all_of<LinearFeed>(run_linuxcnc("G20 G0 X0 Y0 Z0 A0\nG1 X0 F24\nA90\nM2\n"));
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_DOUBLE_EQ(moves[0].feed.value, 24.0 * kMmPerInch);
  EXPECT_DOUBLE_EQ(moves[1].feed.value, 24.0);
}

// What only the machine knows: pins, the configuration, tools in no table, places before a move.
TEST(LinuxCncWords, ValuesOfTheMachineAreNeededOrNot) {
  const auto all = run_linuxcnc(
      "#<a>=[#<_hal[spindle.speed]>+1]\n#<b>=#<_ini[axis_z]max>\n(print, #<a>)\n"
      "o1 if [#<b> gt 1]\nG0 X9\no1 else\nG0 X1\no1 endif\nG1 Y2 F#<a>\nM2\n");
  EXPECT_EQ(last_of<LinearFeed>(all).end[X], 1.0);
  EXPECT_DOUBLE_EQ(last_of<LinearFeed>(all).feed.value, 1000.0);
  std::vector<std::string> assumed;
  for (const Event& event : all_of<Event>(all)) {
    if (event.grade == EventGrade::assumed) assumed.push_back(event.name);
    if (event.name == "print") {
      EXPECT_EQ(event.text, "######");
    }
  }
  EXPECT_EQ(assumed, (std::vector<std::string>{"condition", "feed"}));
  EXPECT_EQ(linuxcnc_ids("G0 X#<_hal[a]>\n"), Ids{"unknown-parameter"});
  EXPECT_EQ(linuxcnc_ids("G0 Y#5420\n"), Ids{"unknown-parameter"});
  EXPECT_EQ(linuxcnc_ids("#5221=#<_hal[a]>\n"), Ids{"unknown-parameter"});
  EXPECT_EQ(linuxcnc_ids("T3 M6\n#1=#5410\nG0 X1\nM2\n"), Ids{});
}

TEST(LinuxCncWords, Fault2_04_ArcsInATurnedPlaneBecomeChords) {
  const auto all = run_linuxcnc("G10 L2 P1 X0 Y0 Z0 R90\nG0 X0 Y0 Z0\nG18 G2 X10 Z0 I5 F100\nM2\n");
  const auto lines = all_of<LinearFeed>(all);
  ASSERT_GT(lines.size(), 100U);
  for (const LinearFeed& line : lines) {
    // X of the words is Y of the offset's frame.
    EXPECT_NEAR(std::hypot(*line.end[Y] - 5.0, *line.end[Z]), 5.0, 1e-9);
  }
  EXPECT_NEAR(*lines.back().end[Y], 10.0, 1e-9);
}

// A quarter of a circle of radius 10: three points of order 3, the middle one of weight 1/sqrt 2.
TEST(LinuxCncWords, SplinesByKnotsTraceTheirCurve) {
  const auto all = run_linuxcnc(
      "G17 G0 X10 Y0 Z0\nF100\nG6.2 P3 Q1 X10 Y0 R1 K0\nX10 Y10 R0.7071067811865476 K0\n"
      "X0 Y10 R1 K0\nK1\nK1\nK1\nG0 X0 Y0\nM2\n");
  const auto arcs = all_of<ArcFeed>(all);
  ASSERT_FALSE(arcs.empty());
  for (const ArcFeed& arc : arcs) EXPECT_LT(arc.center.norm(), 1e-3);
  EXPECT_NEAR(*arcs.back().end[X], 0.0, 1e-9);
  EXPECT_NEAR(*arcs.back().end[Y], 10.0, 1e-9);
  EXPECT_EQ(linuxcnc_ids("G0 X0 Y0 Z0\nG6.2 P3 Q1 X1 Y0 R1 K0 F100\nM2\n"), Ids{"spline-open"});
  EXPECT_EQ(linuxcnc_ids("G0 X0 Y0 Z0\nG6.2 P3 Q1 X1 Y0 R1 K1 F100\nX2 Y2 R1 K0\n"),
            Ids{"spline-knots"});
  EXPECT_EQ(linuxcnc_ids("G0 X0 Y0 Z0\nG6.2 X1 Y0 R1 K0 F100\n"), Ids{"spline-word-missing"});
}

TEST(LinuxCncWords, SplinesFollowTheirPlane) {
  const auto arcs = all_of<ArcFeed>(run_linuxcnc("G18 G0 X0 Y5 Z0\nG5.1 X4 Z0 I2 J4 F100\nM2\n"));
  ASSERT_FALSE(arcs.empty());
  EXPECT_EQ(arcs.front().plane, Plane::zx);
  EXPECT_EQ(arcs.back().end[X], 4.0);
  EXPECT_EQ(arcs.back().end[Y], 5.0);
  // The top of the parabola is half way up to its control point.
  double top = 0.0;
  for (const ArcFeed& arc : arcs) top = std::max(top, *arc.end[Z]);
  EXPECT_NEAR(top, 2.0, 1e-2);
}

}  // namespace
}  // namespace frustum::parser
