// What a program of Klartext leaves to the control or to the operator, and how it is taken: each is
// an event of the grade `assumed`. Cycles whose parameters change after their definition.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

struct TakenRun {
  std::vector<std::string> moves{};  // "X1 Z-2", machine coordinates with a *
  std::vector<std::string> assumptions{};
};
TakenRun taken_run(const std::string& text, const InterpreterOptions& options = {}) {
  TakenRun run;
  const auto spell = [&](const AxisTarget& end, bool machine) {
    std::string line = machine ? "*" : "";
    for (const AxisLetter axis : {X, Y, Z}) {
      if (!end[axis]) continue;
      std::string number = std::to_string(*end[axis]);
      number.erase(number.find_last_not_of('0') + 1);
      if (number.back() == '.') number.pop_back();
      line += (line.size() > 1 ? " " : "") + std::string(1, to_char(axis)) + number;
    }
    run.moves.push_back(line);
  };
  for (const Motion& motion : motions(text, options, Dialect::heidenhain)) {
    if (const auto* rapid = std::get_if<Traverse>(&motion.command)) {
      spell(rapid->end, rapid->coordinates == Coordinates::machine);
    } else if (const auto* feed = std::get_if<LinearFeed>(&motion.command)) {
      spell(feed->end, false);
    } else if (const auto* arc = std::get_if<ArcFeed>(&motion.command)) {
      spell(arc->end, false);
    } else if (const auto* event = std::get_if<Event>(&motion.command)) {
      if (event->grade == EventGrade::assumed) run.assumptions.push_back(event->name);
    }
  }
  return run;
}
using TakenMoves = std::vector<std::string>;
std::string taken_complaint(const std::string& text) {
  const auto all = complaints(text, {}, Dialect::heidenhain);
  return all.empty() ? "" : all.front().substr(0, all.front().find(" (hint"));
}

TEST(KlartextUnknowns, StepsFromTheStartCountFromZero) {
  const TakenRun run = taken_run("L IX+10 F100\nL IX-20\nL IY+5\n");
  EXPECT_EQ(run.moves, (TakenMoves{"X10", "X-10", "X-10 Y5"}));
  EXPECT_EQ(run.assumptions, (TakenMoves{"start"}));
  // Where zero was before a shift nothing says; a shift of another axis does not matter.
  EXPECT_EQ(taken_complaint("CYCL DEF 7.1 X+5\nL IX+10 F100\n"),
            "2:3: error: IX10 is incremental, but X has not been programmed yet");
  EXPECT_EQ(taken_run("CYCL DEF 7.1 Z+5\nL IX+10 F100\n").moves, (TakenMoves{"X10"}));
  InterpreterOptions start;
  start.start[X] = 30.0;
  EXPECT_EQ(taken_run("L IX+10 F100\n", start).moves, (TakenMoves{"X40"}));
}

// The axis is in machine coordinates then, and so is the step.
TEST(KlartextUnknowns, StepsAfterMachineCoordinatesGoOnInThem) {
  const TakenRun run = taken_run("L Z-10 FMAX M91\nL IZ+2 FMAX\nL IZ-5 FMAX\n");
  EXPECT_EQ(run.moves, (TakenMoves{"*Z-10", "*Z-8", "*Z-13"}));
  EXPECT_TRUE(run.assumptions.empty());
}

// A step with M91 counts from the last place that M91 has given.
TEST(KlartextUnknowns, StepsWithinMachineCoordinatesCountFromTheLastPlaceThere) {
  const TakenRun run = taken_run("L X+100 FMAX M91\nL IX+5 FMAX M91\nL IX+5 FMAX M91\n");
  EXPECT_EQ(run.moves, (TakenMoves{"*X100", "*X105", "*X110"}));
  EXPECT_EQ(run.assumptions, (TakenMoves{"M91 step"}));
  EXPECT_EQ(taken_complaint("L X+0 FMAX\nL IX+5 FMAX M91\n"),
            "2:3: error: IX5 is a step from the last place of M91, which has none");
}

TEST(KlartextUnknowns, PlacesAreReadAsFarAsTheyAreKnown) {
  const std::string head = "TOOL CALL 1 Z S1\n";
  // What the program has placed is no assumption.
  TakenRun run =
      taken_run(head + "L X+7 FMAX\nFN 18: SYSREAD Q1 = ID270 NR1 IDX1\nL X+Q1 Y+Q1 FMAX\n");
  EXPECT_EQ(run.moves.back(), "X7 Y7");
  EXPECT_TRUE(run.assumptions.empty());
  // Nor is where machine coordinates have left an axis.
  run = taken_run(head + "L Z-10 FMAX M91\nFN 18: SYSREAD Q1 = ID240 NR1 IDX3\nL X+Q1 FMAX\n");
  EXPECT_EQ(run.moves.back(), "X-10");
  EXPECT_TRUE(run.assumptions.empty());
  // Of an axis that the operator has moved nothing is known.
  run = taken_run(head + "STOP\nFN 18: SYSREAD Q1 = ID270 NR1 IDX2\nQ1 = Q1 + 3\nL X+Q1 FMAX\n");
  EXPECT_EQ(run.moves.back(), "X3");
  EXPECT_EQ(run.assumptions, (TakenMoves{"place"}));
  run = taken_run(head + "L Z-10 FMAX M91\nFN 18: SYSREAD Q1 = ID270 NR1 IDX3\nL X+Q1 FMAX\n");
  EXPECT_EQ(run.moves.back(), "X-10");
  EXPECT_EQ(run.assumptions, (TakenMoves{"place"}));
  // Where it was before a shift of the datum nothing says.
  EXPECT_EQ(taken_complaint("CYCL DEF 7.1 X+5\nFN 18: SYSREAD Q1 = ID270 NR1 IDX1\nL X+Q1 FMAX\n"),
            "3:3: error: X depends on $ID270[1,1], which only the machine knows");
}

TEST(KlartextUnknowns, ConditionsOfTheMachineDoNotHold) {
  const TakenRun run = taken_run(
      "FN 18: SYSREAD Q1 = ID50 NR36 IDX3\nFN 9: IF +Q1 EQU +0 GOTO LBL 1\nL X+1 FMAX\nLBL 1\n"
      "L X+2 FMAX\n");
  EXPECT_EQ(run.moves, (TakenMoves{"X1", "X2"}));
  EXPECT_EQ(run.assumptions, (TakenMoves{"condition"}));
}

TEST(KlartextUnknowns, HolesAfterAToolChangeAreAsHighAsBefore) {
  const std::string cycle =
      "CYCL DEF 1.0 PECKING\nCYCL DEF 1.1 SET UP -2\nCYCL DEF 1.2 DEPTH -6\nCYCL DEF 1.3 PECKG -6\n"
      "CYCL DEF 1.4 DWELL 0\nCYCL DEF 1.5 F100\n";
  const TakenRun run = taken_run("TOOL CALL 1 Z S1\nL X+1 Y+1 Z+2 FMAX\nTOOL CALL 2 Z S1\n" +
                                 cycle + "L X+3 FMAX M99\n");
  // The surface is at 0, as the tool was 2 above it.
  EXPECT_EQ(run.moves, (TakenMoves{"X1 Y1 Z2", "X3 Y1", "X3 Y1 Z2", "X3 Y1 Z-6", "X3 Y1 Z2"}));
  EXPECT_EQ(run.assumptions, (TakenMoves{"height of the hole"}));
  EXPECT_EQ(
      taken_complaint("TOOL CALL 1 Z S1\nL X+1 Y+1 Z+2 FMAX\nL Z+0 FMAX M91\nTOOL CALL 2 Z\n" +
                      cycle + "L X+3 FMAX M99\n"),
      "11:12: error: the height of the hole is not known: Z is not known since the move in "
      "machine coordinates (M91) on line 3");
}

TEST(KlartextUnknowns, TheBuildersDatumIsTheMachines) {
  const TakenRun run = taken_run("L Z-1 FMAX M92\n");
  EXPECT_EQ(run.moves, (TakenMoves{"*Z-1"}));
  EXPECT_EQ(run.assumptions, (TakenMoves{"M92"}));
}

TEST(KlartextUnknowns, ProbesFindWhatTheSetupHas) {
  const std::string probing = "L X+1 Y+2 Z+3 FMAX\nTCH PROBE 411 DATUM Q321=+5 ~\n  Q322=+5\n";
  const TakenRun run = taken_run(probing + "L X+9 FMAX\n");
  EXPECT_EQ(run.moves, (TakenMoves{"X1 Y2 Z3", "X9"}));
  EXPECT_EQ(run.assumptions, (TakenMoves{"TCH PROBE"}));
  EXPECT_EQ(taken_complaint("FN 0: Q151 = +4\n" + probing + "L X+Q151 FMAX\n"),
            "5:3: error: X depends on Q151, which only the machine knows");
  EXPECT_EQ(taken_complaint(probing + "L IX+1 FMAX\n"),
            "4:3: error: IX1 is incremental, but X is not known since the cycle of the probe on "
            "line 2");
  EXPECT_EQ(taken_complaint("TCH PROBE 0.0 REF. PLANE Q5 X-\n"),
            "1:1: error: TCH PROBE is not simulated");
}

TEST(KlartextUnknowns, DrSaysWhichWayHalfATurnGoes) {
  const auto all =
      motions("L X+10 Y+0 FMAX\nCC X+0 Y+0\nCP IPA+180 DR- F100\n", {}, Dialect::heidenhain);
  const auto arc = last_of<ArcFeed>(all);
  EXPECT_LT(arc.turns, 0);
  EXPECT_NEAR(*arc.end[X], -10.0, 1e-9);
  EXPECT_EQ(taken_run("L X+10 Y+0 FMAX\nCC X+0 Y+0\nCP IPA+180 DR- F100\n").assumptions,
            (TakenMoves{"CP"}));
  EXPECT_TRUE(taken_run("L X+10 Y+0 FMAX\nCC X+0 Y+0\nCP IPA-180 DR- F100\n").assumptions.empty());
}

// TOOL CALL 0 with M128: the tip of the tool that is there is guided on and on.
TEST(KlartextUnknowns, TheTipOfNoToolStaysGuided) {
  const TakenRun run =
      taken_run("TOOL CALL 0 Z S1\nL M128\nL X+5 Y+0 Z+1 FMAX\nCC X+0 Y+0\nC X-5 Y+0 DR+ F9\n");
  EXPECT_EQ(run.moves, (TakenMoves{"X5 Y0 Z1", "X-5 Y0 Z1"}));
  EXPECT_EQ(run.assumptions, (TakenMoves{"TOOL CALL"}));
}

constexpr const char* kDrilling200 =
    "TOOL CALL 1 Z S1\nL X+0 Y+0 Z+2 FMAX\nCYCL DEF 200 Q200=2 Q201=-5 Q206=100 Q202=0 Q203=0\n";

TEST(KlartextCycleParameters, CountAsTheyAreAtTheCall) {
  EXPECT_EQ(taken_run(std::string(kDrilling200) + "Q201 = -8\nL X+1 FMAX M99\n").moves,
            (TakenMoves{"X0 Y0 Z2", "X1 Y0 Z2", "X1 Y0 Z-8", "X1 Y0 Z2"}));
  EXPECT_EQ(taken_run(std::string(kDrilling200) + "Q201 = -8\nL X+1 FMAX M99\n").assumptions,
            (TakenMoves{"cycle parameter"}));
  // Not so the parameter that one was set by.
  EXPECT_EQ(taken_run("Q1 = -5\nTOOL CALL 1 Z S1\nL X+0 Y+0 Z+2 FMAX\n"
                      "CYCL DEF 200 Q200=2 Q201=Q1 Q206=100 Q202=0 Q203=0\nQ1 = -8\nCYCL CALL\n")
                .moves,
            (TakenMoves{"X0 Y0 Z2", "X0 Y0 Z-5", "X0 Y0 Z2"}));
  // A definition sets them, for the program to read.
  EXPECT_EQ(taken_run(std::string(kDrilling200) + "L X+Q201 FMAX\n").moves.back(), "X-5 Y0 Z2");
  EXPECT_EQ(taken_complaint(std::string(kDrilling200) + "Q201 = +8\nCYCL CALL\n").substr(0, 4),
            "5:21");
}

TEST(KlartextCycleCalls, AtAPlaceMayHaveAFeedAndMWords) {
  const std::string at = "CYCL CALL POS X+10 Y+20 Z+3 ";
  const TakenMoves moves{"X0 Y0 Z2", "X0 Y0 Z5", "X10 Y20 Z5", "X10 Y20 Z-2", "X10 Y20 Z5"};
  const TakenRun rapid = taken_run(std::string(kDrilling200) + at + "R0 FMAX M8\n");
  EXPECT_EQ(rapid.moves, moves);
  EXPECT_TRUE(rapid.assumptions.empty());
  const TakenRun fed = taken_run(std::string(kDrilling200) + at + "F500 M8\nL X+1 F50\n");
  EXPECT_EQ(TakenMoves(fed.moves.begin(), fed.moves.end() - 1), moves);
  EXPECT_EQ(fed.assumptions, (TakenMoves{"CYCL CALL POS"}));
}

// The control takes the tool for 0.5 longer than it is: the spindle, and with it the tip, stays so
// much higher.
TEST(KlartextTools, DlKeepsTheTipAway) {
  const std::string moves = "L X+1 Y+0 Z+2 FMAX\nCC X+1 Z+0\nC X+3 Z+0 DR+ F9\n";
  const auto all = motions("TOOL CALL 1 Z S1 DL+0.5\n" + moves, {}, Dialect::heidenhain);
  EXPECT_DOUBLE_EQ(*last_of<Traverse>(all).end[Z], 2.5);
  EXPECT_DOUBLE_EQ(*last_of<ArcFeed>(all).end[Z], 0.5);
  EXPECT_DOUBLE_EQ(last_of<ArcFeed>(all).center[2], 0.5);
  // Only the words of the program: not machine coordinates, nor what the turn of a datum does.
  EXPECT_EQ(
      taken_run("TOOL CALL 1 Z S1 DL-0.5\nL Z-1 FMAX M91\nCYCL DEF 7.3 Z+10\nL Z+1 FMAX\n").moves,
      (TakenMoves{"*Z-1", "Z10.5"}));
  // Z stays where it is until it is programmed; the next call ends it.
  EXPECT_EQ(taken_run("TOOL CALL 1 Z S1\nL X+1 Z+2 FMAX\nTOOL CALL DL+0.5\nL X+2 FMAX\n"
                      "L Z+1 FMAX\nTOOL CALL 1 Z S1\nL Z+0 FMAX\n")
                .moves,
            (TakenMoves{"X1 Z2", "X2", "X2 Z1.5", "X2 Z0"}));
}

TEST(KlartextRepeats, JumpsWithinThemDoNotEndThem) {
  // Twice more, though each turn jumps over a block.
  EXPECT_EQ(taken_run("L X+0 FMAX\nLBL 1\nFN 9: IF +1 EQU +1 GOTO LBL 2\nL X+99 FMAX\nLBL 2\n"
                      "L IX+1 FMAX\nCALL LBL 1 REP 2\nL Y+5 FMAX\n")
                .moves,
            (TakenMoves{"X0", "X1", "X2", "X3", "X3 Y5"}));
  // A jump out of one does.
  EXPECT_EQ(
      taken_run(
          "Q1 = 0\nL X+0 FMAX\nLBL 1\nL IX+1 FMAX\nFN 11: IF +Q1 GT +0 GOTO LBL 2\nFN 0: Q1 = +1\n"
          "CALL LBL 1 REP 5\nLBL 2\nL Y+5 FMAX\n"
          "Q1 = 0\n")
          .moves.size(),
      4U);
}

// They matter to a tool that is called larger than it is, or whose tip is guided.
TEST(KlartextSurfaceNormals, ChangeNothingOtherwise) {
  EXPECT_EQ(taken_run("TOOL CALL 1 Z S1 DR+0.2\nL X+1 FMAX\nTOOL CALL 1 Z DR+0\n"
                      "LN X+2 NX+0.6 NY+0 NZ+0.8 FMAX\n")
                .moves,
            (TakenMoves{"X1", "X2"}));
  const std::string guided = "TOOL CALL 1 Z S1\nM128\n";
  EXPECT_EQ(taken_run(guided + "LN X+2 B+5 NX+0 NY+0 NZ+1 FMAX\n").moves.size(), 1U);
  EXPECT_EQ(taken_run(guided + "LN X+2 NX+0 NY+0 NZ+1 TX+0 TY+0 TZ+1 FMAX\n").moves.size(), 1U);
}

TEST(KlartextSpellings, OfTheWorld) {
  EXPECT_EQ(taken_run("L X+1 FMAX   (A REMARK)\n/ 12 L X+2 FMAX\n/13 L X+3 FMAX\n").moves,
            (TakenMoves{"X1", "X2", "X3"}));
  EXPECT_EQ(
      last_of<Dwell>(motions("CYCL DEF9 .0 WAIT\nCYCL DEF9.1 V.TIME5\n", {}, Dialect::heidenhain))
          .seconds,
      5.0);
  const auto stops = all_of<Stop>(motions("STOP M2\n", {}, Dialect::heidenhain));
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_EQ(stops.front().kind, StopKind::program_end);
  const auto halts = all_of<Stop>(motions("STOP M0\n", {}, Dialect::heidenhain));
  ASSERT_EQ(halts.size(), 1U);
  EXPECT_EQ(halts.front().kind, StopKind::program_stop);
  // Brackets of a formula are none.
  EXPECT_EQ(taken_run("Q1 = 2 * ( 1 + 2 )\nL X+Q1 FMAX\n").moves, (TakenMoves{"X6"}));
  EXPECT_EQ(taken_run("CYCL DEF 332.0 TUNING\nQ1 = 5\nL X+Q1 FMAX\n").moves, (TakenMoves{"X5"}));
  EXPECT_EQ(taken_complaint("(A REMARK) X\nL X+1 ( FMAX\n"), "2:7: error: unexpected '('");
}

// From (20, 10) to (50, 10) and up: the rounding of 5 mm begins at (45, 10), though the tool was
// elsewhere and higher before the approach.
TEST(KlartextCorners, OfTheFirstMoveAfterAnApproach) {
  const std::string contour = "L X+50\nRND R5\nL Y+50\nL X+0 Y+60 R0\n";
  for (const std::string before : {"Z-5 R0 FMAX\nAPPR LT X+20 Y+10 LEN5 RL F200\n",
                                   "Z+2 R0 FMAX\nAPPR LT X+20 Y+10 Z-5 LEN5 RL F200\n"}) {
    const auto all = motions("TOOL CALL 1 Z S1\nL X+0 Y+0 " + before + contour,
                             {.contours_without_diameter = true}, Dialect::heidenhain);
    const auto arc = last_of<ArcFeed>(all);
    EXPECT_NEAR(arc.center[0], 45.0, 1e-9);
    EXPECT_NEAR(arc.center[1], 15.0, 1e-9);
    EXPECT_NEAR(*arc.end[X], 50.0, 1e-9);
    EXPECT_NEAR(*arc.end[Y], 15.0, 1e-9);
    EXPECT_EQ(arc.turns, 1);
  }
}

TEST(KlartextCorners, TheSideMayBeWrittenAgain) {
  const std::string text =
      "TOOL CALL 1 Z S1\nL X+0 Y+0 Z-5 R0 FMAX\nL X+10 RL F200\nL X+50 RL\nRND R5\nL Y+50 RL\n"
      "L X+0 Y+60 R0\n";
  const auto all = motions(text, {.contours_without_diameter = true}, Dialect::heidenhain);
  EXPECT_NEAR(*last_of<ArcFeed>(all).end[X], 50.0, 1e-9);
}

// 25 from the pole at X75 Z0, towards X-: angles count from Z+ to X+.
TEST(KlartextPoles, LinesAreInThePlaneOfThePole) {
  const TakenRun run =
      taken_run("L X+50 Y+7 Z+20 FMAX\nCC X+75 Z+0\nLP PR+25 PA-90 F100\nLP PA+0 Y+8\nL X+1 Y+2\n");
  EXPECT_EQ(run.moves, (TakenMoves{"X50 Y7 Z20", "X50 Y7 Z0", "X75 Y8 Z25", "X1 Y2 Z25"}));
}

}  // namespace
}  // namespace frustum::parser
