// Words of Sinumerik programs as mills are sent them: names of tools, edges, arrays, texts,
// roundings and chamfers, words of the builder, patterns of holes.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.hpp"
#include "parser/interpret/moves/plane_path.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run_words(std::string_view text) {
  return motions(text, {}, Dialect::sinumerik);
}

std::vector<std::string> ids_of(std::string_view text) {
  return complaint_ids(text, {}, Dialect::sinumerik);
}

// The texts of the events of that name.
std::vector<std::string> texts_of(const std::vector<Motion>& motions, std::string_view name) {
  std::vector<std::string> texts;
  for (const Event& event : all_of<Event>(motions)) {
    if (event.name == name) texts.push_back(event.text);
  }
  return texts;
}

EventGrade grade_of(const std::vector<Motion>& motions, std::string_view name) {
  for (const Event& event : all_of<Event>(motions)) {
    if (event.name == name) return event.grade;
  }
  ADD_FAILURE() << "no event " << name;
  return EventGrade::known;
}

double x_after(std::string_view text) { return *last_of<Traverse>(run_words(text)).end[X]; }

TEST(SinumerikTools, Fault2_10_GoByTheirNames) {
  const auto all =
      run_words("T=\"DRILL 8.5\"\nM6\nT=\"MILL 10\" M6\nT=\"DRILL 8.5\" M6\nT=\"12\" M6\n");
  std::vector<int> tools;
  for (const ToolChange& change : all_of<ToolChange>(all)) tools.push_back(change.tool);
  EXPECT_EQ(tools, (std::vector<int>{1001, 1002, 1001, 12}));
  EXPECT_EQ(texts_of(all, "tool_name"),
            (std::vector<std::string>{"DRILL 8.5 is tool 1001", "MILL 10 is tool 1002"}));
  EXPECT_EQ(grade_of(all, "tool_name"), EventGrade::assumed);
  EXPECT_EQ(texts_of(run_words("T=\"drill\" M6\nT=\"DRILL\" M6\n"), "tool_name").size(), 1U);
  // A remark of the tool table names its tool.
  InterpreterOptions options;
  options.tools[7] = Tool{.diameter = 8.5, .remark = "Drill 8.5"};
  const auto listed = motions("T=\"DRILL 8.5\" M6\n", options, Dialect::sinumerik);
  EXPECT_EQ(last_of<ToolChange>(listed).tool, 7);
  options.tools[9] = Tool{.diameter = 8.5, .remark = "DRILL 8.5"};
  EXPECT_EQ(complaint_ids("T=\"Drill 8.5\" M6\n", options, Dialect::sinumerik),
            std::vector<std::string>{"tool-name"});
  // A name may be in a variable, and be given by the program.
  EXPECT_EQ(last_of<ToolChange>(run_words("DEF STRING[20] NAME=\"MILL\"\n$TC_TP2[5]=\"MILL\"\n"
                                          "T=NAME M6\n"))
                .tool,
            5);
}

TEST(SinumerikTools, Fault2_10_HaveSeveralEdges) {
  const auto all = run_words("T7 M6\nD2\nD1\nD0\n");
  std::vector<int> numbers;
  for (const auto& change : all_of<CompensationChange>(all))
    numbers.push_back(change.offset_number);
  EXPECT_EQ(numbers, (std::vector<int>{7, 10007, 7, 0}));
  EXPECT_EQ(ids_of("T7 M6\nD13\n"), std::vector<std::string>{"out-of-range"});
}

TEST(SinumerikTools, Fault2_10_KeepTheirLengthInMachineCoordinates) {
  // X and Y have no length.
  const auto plane = run_words("T1 D1 M6\nSUPA G0 X5 Y6 D1\n");
  EXPECT_EQ(last_of<Traverse>(plane).coordinates, Coordinates::machine);
  // The setup has the length: the place is that of no work offset.
  const auto open = run_words("T1 D1 M6\nG54\nSUPA G0 Z5\n");
  EXPECT_EQ(last_of<Traverse>(open).coordinates, Coordinates::program);
  EXPECT_EQ(*last_of<Traverse>(open).end[Z], 5.0);
  std::vector<int> offsets;
  for (const auto& change : all_of<WorkOffsetChange>(open)) offsets.push_back(change.number);
  EXPECT_EQ(offsets, (std::vector<int>{1, 0, 1}));
  EXPECT_EQ(grade_of(open, "machine-coordinates-length"), EventGrade::assumed);
  EXPECT_EQ(ids_of("T1 D1 M6\nTRAORI\nSUPA G0 X5\n"),
            std::vector<std::string>{"tool-length-active"});
  // Without axes G53 holds for a block that moves nothing.
  EXPECT_TRUE(all_of<Traverse>(run_words("G53\n")).empty());
}

TEST(SinumerikSpindles, Fault2_10_AreTheFirstOne) {
  const auto all = run_words("SETMS(1)\nS1=1000 M1=3\n");
  EXPECT_EQ(last_of<SpindleChange>(all).speed, 1000.0);
  EXPECT_EQ(last_of<SpindleChange>(all).direction, SpindleDirection::clockwise);
  const auto second = run_words("S2=500 M2=4\n");
  EXPECT_TRUE(all_of<SpindleChange>(second).empty());
  EXPECT_EQ(texts_of(second, "M"), std::vector<std::string>{"2=4"});
  EXPECT_EQ(grade_of(second, "M"), EventGrade::builder);
}

TEST(SinumerikWords, Fault2_10_OfTheBuilderAreEvents) {
  const auto all = run_words("M202(0.5) H5 H1=2\nM200\nG0 X1 M81\n");
  EXPECT_EQ(texts_of(all, "M"), std::vector<std::string>{"202(0.5)"});
  EXPECT_EQ(grade_of(all, "M200"), EventGrade::builder);
  EXPECT_EQ(grade_of(all, "M81"), EventGrade::builder);
  EXPECT_EQ(texts_of(all, "H"), (std::vector<std::string>{"5", "1=2"}));
  EXPECT_EQ(grade_of(all, "H"), EventGrade::builder);
}

TEST(SinumerikWords, OfATruerToolAndOtherFeedsAreRefusedUnlessTheyAreZero) {
  for (const char* word :
       {"TOFF[Z]=1", "TOFFL=0.1", "TOFFR=0.1", "TOFFLR=0.2", "OFFN=2", "DL=1", "DISC=0.5",
        "TCARR=1", "FXS[X]=1", "FB=100", "FZ=0.1", "SVC=100", "OFFN=0+R1"}) {
    EXPECT_EQ(ids_of(std::string("G0 X1 ") + word + "\n"),
              std::vector<std::string>{"not-supported"})
        << word;
  }
  const auto idle = run_words("G0 X1 OFFN=0 DL=0 TOFFL[2]=0. DISC=0\nTCARR=0\n");
  EXPECT_EQ(texts_of(idle, "TOFFL"), std::vector<std::string>{"0"});
  EXPECT_EQ(all_of<Event>(idle).size(), 5U);
}

TEST(SinumerikWords, ThatMovePlacesUnseenAreRefused) {
  for (const char* frame : {"$P_SETFR[X,TR]=5", "$P_EXTFR[X,TR]=5", "$P_WPFR[X,TR]=1"}) {
    EXPECT_EQ(ids_of(std::string(frame) + "\n"), std::vector<std::string>{"not-simulated"})
        << frame;
  }
  EXPECT_EQ(ids_of("$P_SETFR[X,TR]=0\n"), std::vector<std::string>{});
  EXPECT_EQ(ids_of("DEFINE M6 AS L6\n"), std::vector<std::string>{"not-supported"});
  EXPECT_EQ(ids_of("DEFINE SUPA AS G0\n"), std::vector<std::string>{"not-supported"});
  EXPECT_EQ(ids_of("DEFINE DOOR AS $A_OUT[1]\n"), std::vector<std::string>{});
}

TEST(SinumerikWords, OfAParallelAxisStayAtZero) {
  const auto rests = run_words("G0 X1 Z5 W0\nV=0 X2 W0.0\n");
  EXPECT_EQ(*last_of<Traverse>(rests).end[X], 2.0);
  EXPECT_EQ(grade_of(rests, "W"), EventGrade::assumed);
  EXPECT_EQ(grade_of(rests, "V"), EventGrade::assumed);
  EXPECT_EQ(ids_of("G0 X1 W5\n"), std::vector<std::string>{"not-simulated"});
  EXPECT_EQ(ids_of("G0 X1 W=0+R1\n"), std::vector<std::string>{"not-simulated"});
}

TEST(SinumerikExpressions, HaveNumbersWithAnExponent) {
  EXPECT_DOUBLE_EQ(x_after("G0 X=1.5EX2\n"), 150.0);
  EXPECT_DOUBLE_EQ(x_after("R1=-2EX-3\nG0 X=R1*1EX+3\n"), -2.0);
  EXPECT_EQ(ids_of("G0 X=2EX\n"), std::vector<std::string>{"unknown-word"});
}

TEST(SinumerikWords, Fault2_10_SwitchTheTransformationOffHoweverTheyAreSpelled) {
  for (const char* off : {"TRAFOOF", "TRAFOOF()", "TRAOOF"}) {
    const auto all = run_words(std::string("T1 D1 M6\nTRAORI(1)\n") + off + "\n");
    EXPECT_EQ(last_of<CompensationChange>(all).mode, LengthCompensation::length) << off;
  }
  EXPECT_EQ(grade_of(run_words("TRAOOF\n"), "TRAOOF"), EventGrade::assumed);
}

TEST(SinumerikExpressions, Fault2_10_SquareAndBound) {
  EXPECT_EQ(x_after("G0 X=POT(3)\n"), 9.0);
  EXPECT_EQ(x_after("G0 X=BOUND(1,5,7)\n"), 5.0);
  EXPECT_EQ(x_after("G0 X=BOUND(1,5,-7)\n"), 1.0);
  EXPECT_EQ(x_after("R1=6\nG0 X=(R1 B_AND 3)+(R1 B_OR 1)\n"), 9.0);
  EXPECT_EQ(x_after("G0 X='H1F'+'B101'\n"), 36.0);
}

TEST(SinumerikArrays, AreGivenToPrograms) {
  // VAR gives the array back, without it the program has its own; sizes may be open.
  const std::string call = "DEF REAL FIELD[3]\nFIELD[1]=4\nDOUBLE(FIELD)\nG0 X=FIELD[1]\nM30\n";
  const std::string body = "FIELD2[1]=2*FIELD2[1]\nRET\n";
  const auto run = [&](const std::string& head) { return call + head + body; };
  EXPECT_EQ(x_after(run("%_N_DOUBLE_SPF\nPROC DOUBLE(VAR REAL FIELD2[3])\n")), 8.0);
  EXPECT_EQ(x_after(run("%_N_DOUBLE_SPF\nPROC DOUBLE(VAR REAL FIELD2[])\n")), 8.0);
  EXPECT_EQ(x_after(run("%_N_DOUBLE_SPF\nPROC DOUBLE(REAL FIELD2[3])\n")), 4.0);
  EXPECT_EQ(ids_of(run("%_N_DOUBLE_SPF\nPROC DOUBLE(VAR REAL FIELD2[4])\n")),
            std::vector<std::string>{"call-arguments"});
  EXPECT_EQ(ids_of(run("%_N_DOUBLE_SPF\nPROC DOUBLE(VAR REAL FIELD2[3,1])\n")),
            std::vector<std::string>{"call-arguments"});
  EXPECT_EQ(ids_of("DEF REAL FIELD[3]\nBOTH(FIELD,FIELD)\nM30\n%_N_BOTH_SPF\n"
                   "PROC BOTH(VAR REAL ONE[3], VAR REAL TWO[3])\nRET\n"),
            std::vector<std::string>{"call-arguments"});
}

TEST(SinumerikArrays, Fault2_10_HoldNumbers) {
  EXPECT_EQ(x_after("DEF REAL A[3]\nA[1]=4\nG0 X=A[1]+A[2]\n"), 4.0);
  EXPECT_EQ(x_after("DEF INT FIELD[2,3]\nFIELD[1,0]=SET(1.4,2,3)\n"
                    "G0 X=FIELD[1,0]+10*FIELD[1,2]\n"),
            31.0);
  EXPECT_EQ(x_after("DEF REAL FIELD[4]=SET(1,2)\nFIELD[2]=REP(7)\nR1=1\n"
                    "G0 X=FIELD[R1]+FIELD[R1+2]\n"),
            9.0);
  EXPECT_EQ(ids_of("DEF REAL A[3]\nA[3]=1\n"), std::vector<std::string>{"array-index"});
  EXPECT_EQ(ids_of("DEF REAL A[3]\nA[0,1]=1\n"), std::vector<std::string>{"array-index"});
  EXPECT_EQ(ids_of("DEF REAL A[0]\n"), std::vector<std::string>{"array-size"});
  EXPECT_EQ(ids_of("DEF REAL A[2]\nA[0]=SET(1,2,3)\n"), std::vector<std::string>{"array-index"});
}

TEST(SinumerikVariables, Fault2_10_ComeBackFromACall) {
  EXPECT_EQ(x_after("DEF REAL WIDTH=5\nTWICE(WIDTH,3)\nG0 X=WIDTH\nM30\n"
                    "PROC TWICE(VAR REAL VALUE, REAL MORE)\nVALUE=VALUE*2+MORE\nRET\n"),
            13.0);
  EXPECT_EQ(ids_of("TWICE(5)\nM30\nPROC TWICE(VAR REAL VALUE)\nRET\n"),
            std::vector<std::string>{"call-arguments"});
}

TEST(SinumerikVariables, HoldTexts) {
  EXPECT_EQ(x_after("DEF STRING[10] NAME=\"A\"<<2\nIF NAME==\"A2\"\nG0 X1\nELSE\nG0 X2\nENDIF\n"),
            1.0);
  EXPECT_EQ(ids_of("DEF STRING[10] NAME=\"A\"\nR1=NAME+1\n"),
            std::vector<std::string>{"wrong-type"});
  EXPECT_EQ(texts_of(run_words("R1=2\nMSG(\"A \"<<R1)\n"), "message"),
            std::vector<std::string>{"\"A \"<<R1"});
}

// What only the machine knows is an error where the way depends on it, and nowhere else.
TEST(SinumerikVariables, OfTheMachineAreUnknown) {
  EXPECT_TRUE(ids_of("R1=$AA_IM[X]+1\nR2=_GLOBAL*2\nG0 X5\n").empty());
  EXPECT_EQ(ids_of("R1=$AA_IM[X]+1\nG0 X=R1\n"), std::vector<std::string>{"unknown-value"});
  EXPECT_EQ(ids_of("IF _GLOBAL==1 GOTOF END1\nEND_1:\n"),
            std::vector<std::string>{"unknown-value"});
  EXPECT_EQ(x_after("IF $P_SEARCH==1\nG0 X1\nELSE\nG0 X2\nENDIF\n"), 2.0);
  const auto all = run_words("_GLOBAL=5\nG0 X=_GLOBAL\n");
  EXPECT_EQ(grade_of(all, "_GLOBAL"), EventGrade::builder);
  EXPECT_EQ(*last_of<Traverse>(all).end[X], 5.0);
}

TEST(SinumerikVariables, OfToolsAndOffsetsCount) {
  const auto contour = run_words(
      "$TC_DP6[1,1]=5\nT1 D1 M6\nG0 X0 Y-20\nG41 G1 X0 Y0 F100\nX50\n"
      "G40 Y-20\n");
  EXPECT_NEAR(*all_of<LinearFeed>(contour).at(0).end[Y], 5.0, 1e-9);
  InterpreterOptions job;
  entry_of(job.tools, 1).diameter = 8.0;
  entry_of(job.tools, 1).has_diameter = true;
  const auto told = all_of<Event>(motions("$TC_DP6[1,1]=5\n", job, Dialect::sinumerik));
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[1].text, "the radius 5 mm of tool 1 goes before 4 mm, which it had");
  EXPECT_EQ(told[1].grade, EventGrade::assumed);
  const auto shifted = run_words(
      "$P_UIFR[1,X,TR]=7\n$P_UIFR[2]=CTRANS(X,3,Y,4):CROT(Z,90)\nG55\n"
      "G0 X1 Y0 Z0\n");
  EXPECT_EQ(all_of<WorkOffsetSetting>(shifted).at(0).origin.at(0), 3.0);
  // Of the offset in force too, from its next word on.
  const auto again = run_words("$P_UIFR[1,X,TR]=7\nG54\nG0 X1 Y0 Z0\n");
  EXPECT_EQ(all_of<WorkOffsetSetting>(again).at(0).origin.at(0), 7.0);
  EXPECT_TRUE(all_of<WorkOffsetSetting>(run_words("$P_UIFR[1,X,TR]=7\nG0 X1 Y0 Z0\n")).empty());
  EXPECT_EQ(x_after("$P_PFRAME=CTRANS(X,10):CMIRROR(X)\nG0 X1 Y0 Z0\n"), 9.0);
  EXPECT_EQ(ids_of("$TC_DP3[1,1]=5\n"), std::vector<std::string>{"not-simulated"});
  EXPECT_EQ(ids_of("$TC_DP15[1,1]=0.1\n"), std::vector<std::string>{"not-simulated"});
  EXPECT_EQ(ids_of("$TC_DP6[1,2]=4\n"), std::vector<std::string>{"not-simulated"});
  EXPECT_EQ(ids_of("$AA_OFF[X]=3\n"), std::vector<std::string>{"not-simulated"});
  EXPECT_EQ(ids_of("$P_UIFR[1,X,TR]=$AA_IM[X]\n"), std::vector<std::string>{"unknown-value"});
  EXPECT_EQ(ids_of("$P_UIFR[1]=CROT(X,5)\n"), std::vector<std::string>{"not-simulated"});
}

// Where the moves of the contour end, one after the other.
std::vector<Vec2> ends_of(const std::vector<Motion>& motions) {
  std::vector<Vec2> ends;
  for (const Motion& motion : motions) {
    if (const auto* line = std::get_if<LinearFeed>(&motion.command)) {
      ends.emplace_back(*line->end[X], *line->end[Y]);
    } else if (const auto* arc = std::get_if<ArcFeed>(&motion.command)) {
      ends.emplace_back(*arc->end[X], *arc->end[Y]);
    }
  }
  return ends;
}

void expect_ends(std::string_view text, const std::vector<Vec2>& expected) {
  const auto ends = ends_of(run_words(text));
  ASSERT_EQ(ends.size(), expected.size()) << text;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    EXPECT_NEAR((ends[i] - expected[i]).norm(), 0.0, 1e-9) << text << " move " << i;
  }
}

TEST(SinumerikCorners, Fault2_10_AreRoundedAndBroken) {
  expect_ends("G0 X0 Y0\nG1 X10 RND=2 F100\nY10\n", {{8, 0}, {10, 2}, {10, 10}});
  const auto rounded = run_words("G0 X0 Y0\nG1 X10 RND=2 F100\nY10\n");
  EXPECT_EQ(all_of<ArcFeed>(rounded).at(0).turns, 1);
  EXPECT_NEAR(all_of<ArcFeed>(rounded).at(0).center.x(), 8.0, 1e-9);
  // CHR= is the width at the corner, CHF= the length of the chamfer.
  expect_ends("G0 X0 Y0\nG1 X10 CHR=2 F100\nY10\n", {{8, 0}, {10, 2}, {10, 10}});
  const double share = 2.0 / std::sqrt(2.0);
  expect_ends("G0 X0 Y0\nG1 X10 CHF=2 F100\nY10\n", {{10 - share, 0}, {10, share}, {10, 10}});
  // RNDM= rounds all corners from there on; a contour that leads on has none.
  expect_ends("G0 X0 Y0 RNDM=1 F100\nG1 X10\nX20\nY10\nRNDM=0\nX0\n",
              {{10, 0}, {19, 0}, {20, 1}, {20, 9}, {19, 10}, {0, 10}});
  // In other planes, too.
  const auto across = run_words("G18\nG0 X0 Y5 Z0\nG1 X10 RND=2 F100\nZ10\n");
  EXPECT_EQ(all_of<ArcFeed>(across).at(0).plane, Plane::zx);
  EXPECT_NEAR(*all_of<ArcFeed>(across).at(0).end[Z], 2.0, 1e-9);
}

TEST(SinumerikCorners, Fault2_10_HaveTheirOwnFeedOrThatOfTheNextMove) {
  const auto next = all_of<LinearFeed>(run_words("G0 X0 Y0\nG1 X10 CHR=2 F100\nY10 F300\n"));
  EXPECT_EQ(next.at(1).feed.value, 300.0);
  const auto own = all_of<LinearFeed>(run_words("G0 X0 Y0\nG1 X10 CHR=2 FRC=50 F100\nY10\n"));
  EXPECT_EQ(own.at(1).feed.value, 50.0);
  EXPECT_EQ(own.at(2).feed.value, 100.0);
  EXPECT_EQ(grade_of(run_words("G0 X0 Y0\nG1 X10 CHR=2 F100\nY10\n"), "corner-feed"),
            EventGrade::assumed);
}

TEST(SinumerikCorners, Fault2_10_AreLeftOutWhereTheContourEnds) {
  expect_ends("G0 X0 Y0 Z0\nG1 X10 RND=2 F100\nM30\n", {{10, 0}});
  expect_ends("G0 X0 Y0 Z0\nG1 X10 RND=2 F100\nZ5\nY10\n", {{10, 0}, {10, 0}, {10, 10}});
  expect_ends("G0 X0 Y0 Z0\nG1 X10 RND=2 F100\nRET\n", {{10, 0}});
  EXPECT_EQ(ids_of("G0 X0 Y0\nG1 X10 RND=20 F100\nY10\n"),
            std::vector<std::string>{"corner-too-large"});
  EXPECT_EQ(ids_of("G1 X10 RND=2 CHF=1 F100\n"), std::vector<std::string>{"corner-twice"});
  EXPECT_EQ(ids_of("G1 X10 RND=-2 F100\n"), std::vector<std::string>{"value-negative"});
}

// Where the tool goes by rapid in the plane, with a drilling cycle in force.
std::vector<Vec2> holes_of(const std::string& pattern) {
  std::vector<Vec2> holes;
  const auto all =
      run_words("F100\nG0 X0 Y0 Z10\nMCALL CYCLE81(5,0,1,-3)\n" + pattern + "\nMCALL\n");
  for (const LinearFeed& feed : all_of<LinearFeed>(all)) {
    holes.emplace_back(*feed.end[X], *feed.end[Y]);
  }
  return holes;
}

TEST(SinumerikPatterns, DrillRowsCirclesAndGrids) {
  const auto row = holes_of("HOLES1(10,20,0,5,10,3)");
  ASSERT_EQ(row.size(), 3U);
  EXPECT_NEAR((row[0] - Vec2(15, 20)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((row[2] - Vec2(35, 20)).norm(), 0.0, 1e-9);
  // From the nearer end.
  const auto back = holes_of("HOLES1(-100,0,0,0,50,3)");
  ASSERT_EQ(back.size(), 3U);
  EXPECT_NEAR(back[0].x(), 0.0, 1e-9);
  EXPECT_NEAR(back[2].x(), -100.0, 1e-9);
  const auto circle = holes_of("HOLES2(0,0,10,90,0,4)");
  ASSERT_EQ(circle.size(), 4U);
  EXPECT_NEAR((circle[0] - Vec2(0, 10)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((circle[1] - Vec2(-10, 0)).norm(), 0.0, 1e-9);
  const auto grid = holes_of("CYCLE801(10,20,0,5,7,2,2)");
  ASSERT_EQ(grid.size(), 4U);
  EXPECT_NEAR((grid[2] - Vec2(15, 27)).norm(), 0.0, 1e-9);
}

TEST(SinumerikPatterns, DrillGridsFromTheNearestCorner) {
  // The tool is at 0 0. Columns, since they are closer than rows, from the far corner.
  const auto grid = holes_of("CYCLE801(-30,-20,0,30,10,2,3)");
  const std::vector<Vec2> expected{{0, 0}, {0, -10}, {0, -20}, {-30, -20}, {-30, -10}, {-30, 0}};
  ASSERT_EQ(grid.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR((grid[i] - expected[i]).norm(), 0.0, 1e-9) << i;
  }
  // Turned by 90 degrees: rows go along Y.
  const auto turned = holes_of("CYCLE801(5,5,90,10,20,2,2)");
  ASSERT_EQ(turned.size(), 4U);
  EXPECT_NEAR((turned[0] - Vec2(5, 5)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((turned[1] - Vec2(5, 15)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((turned[2] - Vec2(-15, 15)).norm(), 0.0, 1e-9);
}

TEST(SinumerikWords, TwoCoolantsRunAtOnce) {
  EXPECT_TRUE(all_of<CoolantChange>(run_words("M7 M8\n")).at(0).flood);
  EXPECT_TRUE(all_of<CoolantChange>(run_words("M8 M7\n")).at(0).flood);
  EXPECT_EQ(ids_of("M8 M9\n"), std::vector<std::string>{"word-twice"});
  EXPECT_EQ(ids_of("M7 M9\n"), std::vector<std::string>{"word-twice"});
}

TEST(SinumerikWords, CuttingMoveBeforeTheFirstFeedHasThatOfTheControl) {
  const auto all = run_words("G0 X0\nG1 X5\nX6 F100\n");
  EXPECT_EQ(all_of<LinearFeed>(all).at(0).feed.value, 0.0);
  EXPECT_EQ(all_of<LinearFeed>(all).at(1).feed.value, 100.0);
  EXPECT_EQ(grade_of(all, "feed"), EventGrade::assumed);
  InterpreterOptions strict;
  strict.control.feed_before_first_word = false;
  EXPECT_EQ(complaint_ids("G1 X5\n", strict, Dialect::sinumerik),
            std::vector<std::string>{"feed-missing"});
}

TEST(SinumerikPrograms, OfLathesAreRefusedWithOneSentence) {
  EXPECT_EQ(ids_of("DIAMON\nG0 BOGUS=5 X\nCYCLE95(\"A\")\n"),
            std::vector<std::string>{"not-milling"});
  EXPECT_EQ(ids_of("G0 X1\nCYCLE95(\"A:B\",1,0,0)\n"), std::vector<std::string>{"not-milling"});
}

TEST(SinumerikPrograms, CallOthersByTheirNames) {
  const std::string rest = "\nM30\n%_N_SLOT_SPF\nG0 X7\nRET\n";
  for (const char* call : {"CALL \"SLOT\"", "CALL \"/_N_SPF_DIR/_N_SLOT_SPF\"",
                           "EXTCALL(\"SLOT.SPF\")", "PCALL SLOT", "EXTCALL \"SLOT\""}) {
    EXPECT_EQ(x_after(call + rest), 7.0) << call;
  }
  EXPECT_EQ(ids_of("DEF STRING[9] NAME\nCALL NAME\n"),
            std::vector<std::string>{"missing-subprogram"});
}

TEST(SinumerikPrograms, HaveManyWorkOffsets) {
  EXPECT_EQ(last_of<WorkOffsetChange>(run_words("G507\n")).number, 7);
  EXPECT_EQ(last_of<WorkOffsetChange>(run_words("G599\n")).number, 99);
  EXPECT_EQ(ids_of("G291\n"), std::vector<std::string>{"not-simulated"});
  EXPECT_EQ(ids_of("G43 H1\n"), std::vector<std::string>{"not-simulated"});
  EXPECT_TRUE(ids_of("G290\nG62\n").empty());
}

TEST(SinumerikPrograms, BeginWithG1) {
  EXPECT_EQ(*last_of<LinearFeed>(run_words("F100\nX5\n")).end[X], 5.0);
}

}  // namespace
}  // namespace frustum::parser
