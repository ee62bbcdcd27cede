// Words of Klartext as programs of the world have them: spellings, M functions, cycles, datums.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run_klartext_words(const std::string& text) {
  return motions(text, {}, Dialect::heidenhain);
}
std::vector<Vec3> ends_of_klartext(const std::vector<Motion>& all) {
  std::vector<Vec3> found;
  for (const Motion& motion : all) {
    const AxisTarget* end = nullptr;
    if (const auto* rapid = std::get_if<Traverse>(&motion.command)) end = &rapid->end;
    if (const auto* feed = std::get_if<LinearFeed>(&motion.command)) end = &feed->end;
    if (const auto* arc = std::get_if<ArcFeed>(&motion.command)) end = &arc->end;
    if (end == nullptr) continue;
    found.emplace_back((*end)[X].value_or(-999), (*end)[Y].value_or(-999),
                       (*end)[Z].value_or(-999));
  }
  return found;
}
void expect_klartext_ends(const std::string& text, const std::vector<Vec3>& expected) {
  const auto found = ends_of_klartext(run_klartext_words(text));
  ASSERT_EQ(found.size(), expected.size()) << text;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT((found[i] - expected[i]).norm(), 1e-9) << i << ": " << found[i].transpose() << "\n"
                                                     << text;
  }
}
const Event* klartext_event(const std::vector<Motion>& all, std::string_view name) {
  for (const Motion& motion : all) {
    const auto* event = std::get_if<Event>(&motion.command);
    if (event != nullptr && event->name == name) return event;
  }
  return nullptr;
}

TEST(KlartextWords, Fault2_09_FeedsOfParametersAndOfM128AreTwo) {
  const auto all =
      run_klartext_words("TOOL CALL 1 Z S1000\nQ3 = 300\nQ9 = 900\nL X+1 FQ3 M128 FQ9\n");
  EXPECT_EQ(last_of<LinearFeed>(all).feed.value, 300.0);
  const Event* event = klartext_event(all, "M128");
  ASSERT_NE(event, nullptr);
  EXPECT_EQ(event->text, "FQ9");
}

TEST(KlartextWords, Fault2_09_LabelsAndFunctionsMayRunOn) {
  expect_klartext_ends(
      "L X+0 FMAX\nFN0: Q1 = +5\nFN 1 : Q1 = +Q1 + +1\nCALL LBL1\nCALL LBL 1\nM30\nLBL1\nL IX+Q1 "
      "FMAX\nLBL0\n",
      {{0, -999, -999}, {6, -999, -999}, {12, -999, -999}});
  expect_klartext_ends(
      "N10 L X+0 FMAX\nCYCLE DEF 9.0 DWELL TIME\nCYCLE DEF 9.1 5\nTOOL DEF1 L+0 R+5\n",
      {{0, -999, -999}});
}

// R has been passed over, and the contour been the path.
TEST(KlartextWords, ToolDefGivesTheRadiusOfTheTool) {
  const std::string contour =
      "TOOL CALL 5 Z S1000\nL X-20 Y+0 Z+2 R0 FMAX\nL X+0 RL F100\nL X+30\n";
  const auto paths = [&](const std::string& before, const InterpreterOptions& options = {}) {
    return motions(before + contour + "L Y+50 R0\n", options, Dialect::heidenhain);
  };
  // To the left of a way along +X: 5 higher in Y.
  const auto moves = all_of<LinearFeed>(paths("TOOL DEF 5 L+0 R+5\n"));
  ASSERT_GE(moves.size(), 2U);
  EXPECT_NEAR(*moves[0].end[Y], 5.0, 1e-12);
  EXPECT_NEAR(*moves[1].end[Y], 5.0, 1e-12);
  EXPECT_NEAR(*moves[1].end[X], 30.0, 1e-12);
  EXPECT_NEAR(*all_of<LinearFeed>(paths("Q1 = 3\nTOOL DEF 5 R+Q1\n")).at(1).end[Y], 3.0, 1e-12);
  EXPECT_NEAR(*all_of<LinearFeed>(paths("0 BEGIN PGM A INCH\nTOOL DEF 5 R+0.1\n")).at(1).end[Y],
              2.54, 1e-12);
  // The path of the centre.
  EXPECT_NEAR(*all_of<LinearFeed>(paths("TOOL DEF 5 L+0 R+0\n")).at(1).end[Y], 0.0, 1e-12);
  // It goes before what the job has, and that is told.
  InterpreterOptions job;
  entry_of(job.tools, 5).diameter = 8.0;
  entry_of(job.tools, 5).has_diameter = true;
  const auto other = paths("TOOL DEF 5 R+5\n", job);
  EXPECT_NEAR(*all_of<LinearFeed>(other).at(1).end[Y], 5.0, 1e-12);
  const Event* told = klartext_event(other, "TOOL DEF 5");
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->grade, EventGrade::assumed);
  EXPECT_EQ(told->text, "the radius 5 mm of tool 5 goes before 4 mm, which it had");
  EXPECT_EQ(klartext_event(paths("TOOL DEF 5 R+4\n", job), "TOOL DEF 5"), nullptr);
  // Lengths are the job's.
  EXPECT_EQ(klartext_event(paths("TOOL DEF 5 L+80 R+5\n"), "TOOL DEF")->grade, EventGrade::assumed);
  EXPECT_EQ(klartext_event(paths("TOOL DEF 5\n", job), "TOOL DEF")->grade, EventGrade::known);
  EXPECT_EQ(klartext_event(paths("TOOL DEF \"DRILL\"\n", job), "TOOL DEF")->text, "\"DRILL\"");
  const auto with_feed = paths("TOOL DEF5 L+30,000 F300 R5. ; CUTTER\n");
  EXPECT_NEAR(*all_of<LinearFeed>(with_feed).at(1).end[Y], 5.0, 1e-12);
  EXPECT_NE(klartext_event(with_feed, "TOOL DEF F"), nullptr);
  for (const std::string wrong :
       {"TOOL DEF 5 R-5\n", "TOOL DEF 5 R+5 S9\n", "TOOL DEF L+0 R+5\n"}) {
    EXPECT_FALSE(failures_of(wrong, {}, Dialect::heidenhain).empty()) << wrong;
  }
}

// R, F and M without a number are what a dialog has left empty.
TEST(KlartextWords, Fault2_09_WordsWithoutNumbersChangeNothing) {
  expect_klartext_ends("L X+1 R F500 M\nL Y+2 R F M\nZ+3 R0 FMAX\nS1000 M3\nR0 FMAX M5\n",
                       {{1, -999, -999}, {1, 2, -999}, {1, 2, 3}});
  EXPECT_EQ(last_of<SpindleChange>(run_klartext_words("S1200 M3\n")).speed, 1200.0);
}

TEST(KlartextWords, Fault2_09_InchesAreIn) {
  const auto all = run_klartext_words("0 BEGIN PGM A IN\n1 L X+1 FMAX\n2 END PGM B IN\n");
  EXPECT_DOUBLE_EQ(*last_of<Traverse>(all).end[X], kMmPerInch);
  // Another name at the end ends the program all the same, and is told.
  EXPECT_NE(klartext_event(all, "END PGM"), nullptr);
  EXPECT_EQ(all_of<Stop>(all).size(), 1U);
}

TEST(KlartextWords, Fault2_09_FeedsOfRotaryAxesAreEvents) {
  const auto all = run_klartext_words("L M116\nL B+10 F500\nL M117\nM103 F20\nM120 LA5\nM94 C\n");
  for (const char* name : {"M116", "M117", "M103", "M120", "M94"}) {
    EXPECT_NE(klartext_event(all, name), nullptr) << name;
  }
}

// Where the travel ends is the machine's; along the tool otherwise.
TEST(KlartextWords, Fault2_09_M140Retracts) {
  const auto home = run_klartext_words("M140 MB MAX\n");
  EXPECT_TRUE(last_of<HomeReturn>(home).axes[2]);
  const Event* told = klartext_event(home, "M140 MB MAX");
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->grade, EventGrade::assumed);
  expect_klartext_ends("L X+1 Y+2 Z+3 FMAX\nL M140 MB+50 FMAX\n", {{1, 2, 3}, {1, 2, 53}});
  const auto lost = complaints("L Z+3 FMAX\nM140 MB MAX\nL IZ+1 FMAX\n", {}, Dialect::heidenhain);
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_TRUE(lost[0].starts_with("3:3: error: IZ1 is incremental")) << lost[0];
}

TEST(KlartextWords, Fault2_09_OneAngleOfCycle19IsEnough) {
  const auto all = run_klartext_words("CYCL DEF 19.0 PLANE\nCYCL DEF 19.1 A+30\n");
  const auto plane = last_of<TiltedPlaneChange>(all).program_from_plane.value_or(Pose{});
  EXPECT_NEAR(plane.rotation(1, 1), std::cos(30 * kRadPerDeg), 1e-12);
  EXPECT_FALSE(complaints("CYCL DEF 19.1 A+30 C+20\n", {}, Dialect::heidenhain).empty());
}

// Q120 to Q122 are where the axes have to be for the plane.
TEST(KlartextWords, TheAxesGoWhereThePlaneWantsThem) {
  const auto all = run_klartext_words(
      "PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY\nL A+Q120 C+Q122 R0 FMAX\nL X+1 Y+2 Z+3 FMAX\n");
  EXPECT_EQ(all_of<AlignToPlane>(all).size(), 1U);
  EXPECT_EQ(all_of<Traverse>(all).size(), 1U);
  EXPECT_FALSE(failures_of("L A+Q120 C+Q122 FMAX\n", {}, Dialect::heidenhain).empty());
}

// The tool in the spindle is the one of the setup.
TEST(KlartextWords, TheTipMayBeGuidedBeforeAToolIsCalled) {
  const auto all = run_klartext_words("M128\nL X+1 A+10 FMAX\n");
  EXPECT_EQ(last_of<CompensationChange>(all).mode, LengthCompensation::tool_centre_point);
  EXPECT_EQ(klartext_event(all, "TOOL CALL")->grade, EventGrade::assumed);
}

TEST(KlartextWords, AWholeTurnGoesTheWayOfDr) {
  const auto arc =
      last_of<ArcFeed>(run_klartext_words("L X+5 Y+0 Z+0 F100\nCC X+0 Y+0\nCP IPA+360 DR-\n"));
  EXPECT_EQ(arc.turns, -1);
  EXPECT_FALSE(
      failures_of("L X+5 Y+0 Z+0 F100\nCC X+0 Y+0\nCP IPA+90 DR-\n", {}, Dialect::heidenhain)
          .empty());
}

// The caller of a subprogram, or the operator, has given the feed.
TEST(KlartextWords, AMoveBeforeTheFirstFeedIsAnAssumption) {
  const auto all = run_klartext_words("L X+1\nL Y+1\n");
  EXPECT_EQ(all_of<LinearFeed>(all).size(), 2U);
  const Event* told = klartext_event(all, "feed");
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->grade, EventGrade::assumed);
}

TEST(KlartextWords, Fault2_09_FormulasHaveMoreFunctions) {
  const auto place = [](const std::string& formula) {
    return *last_of<Traverse>(run_klartext_words("Q2 = -2.75\nQ1 = " + formula + "\nL X+Q1 FMAX\n"))
                .end[X];
  };
  EXPECT_NEAR(place("ATAN 1"), 45.0, 1e-12);
  EXPECT_NEAR(place("2 * ATAN NEG 1"), -90.0, 1e-12);
  EXPECT_NEAR(place("FRAC Q2"), -0.75, 1e-12);
  EXPECT_NEAR(place("SGN Q2"), -1.0, 1e-12);
  EXPECT_NEAR(place("SGN 0 + SGN 5"), 1.0, 1e-12);
  EXPECT_NEAR(place("LOG 1000"), 3.0, 1e-12);
  EXPECT_NEAR(place("400 % 360"), 40.0, 1e-12);
}

// What the program can know of the control, and what it cannot.
TEST(KlartextWords, Fault2_09_SystemDataAreReadWhereTheyAreKnown) {
  const auto read = [](const std::string& data) {
    return *last_of<Traverse>(
                run_klartext_words("TOOL CALL 7 Z S900\nL X+1 Y-2.5 C+30 FMAX M8\nFN 18: "
                                   "SYSREAD Q1 = " +
                                   data + "\nL Z+Q1 FMAX\n"))
                .end[Z];
  };
  EXPECT_EQ(read("ID20 NR1"), 7.0);
  EXPECT_EQ(read("ID20 NR4"), 900.0);
  EXPECT_EQ(read("ID20 NR8"), 1.0);
  EXPECT_EQ(read("ID270 NR1 IDX2"), -2.5);
  EXPECT_NEAR(read("ID270 NR1 IDX6"), 30.0, 1e-12);
  EXPECT_EQ(read("ID210 NR6"), 0.0);
  EXPECT_EQ(read("ID280 NR1"), 0.0);
  // What is not known is an error where the path depends on it, and nowhere else.
  EXPECT_TRUE(failures_of("FN18: SYSREAD Q1 = ID230 NR2 IDX3\nQ2 = Q1 + 5\nL X+1 FMAX\n", {},
                          Dialect::heidenhain)
                  .empty());
  const auto lines = complaints("FN18: SYSREAD Q1 = ID230 NR2 IDX3\nQ2 = Q1 + 5\nL Z+Q2 FMAX\n", {},
                                Dialect::heidenhain);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].starts_with("3:3: error: Z depends on $ID230[2,3]")) << lines[0];
}

TEST(KlartextWords, Fault2_09_ToolsHaveNames) {
  InterpreterOptions options;
  const auto tools = [&](const std::string& text) {
    std::vector<int> numbers;
    for (const ToolChange& change : all_of<ToolChange>(motions(text, options, Dialect::heidenhain)))
      numbers.push_back(change.tool);
    return numbers;
  };
  options.tools[4].remark = "MILL_10";
  const auto numbers = tools(
      "TOOL CALL \"MILL_10\" Z S1000\nQS1 = \"MILL\" || \"_10\"\nTOOL CALL QS1 "
      "Z\nTOOL CALL \"DRILL\" Z\nTOOL CALL 5.1 Z\nTOOL CALL \"DRILL\" Z\n");
  ASSERT_EQ(numbers.size(), 5U);
  EXPECT_EQ(numbers[0], 4);
  EXPECT_EQ(numbers[1], 4);
  EXPECT_EQ(numbers[2], numbers[4]);
  EXPECT_NE(numbers[2], numbers[3]);
  EXPECT_NE(numbers[2], 4);
  EXPECT_NE(
      klartext_event(motions("TOOL CALL \"DRILL\" Z\n", options, Dialect::heidenhain), "tool_name"),
      nullptr);
}

TEST(KlartextWords, TheBuildersMWordsAreTold) {
  const Event* event = nullptr;
  const auto all = run_klartext_words("M25\nL X+1 FMAX M85\n");
  for (const char* name : {"M25", "M85"}) {
    event = klartext_event(all, name);
    ASSERT_NE(event, nullptr) << name;
    EXPECT_EQ(event->grade, EventGrade::builder);
  }
}

// A pole in Z/X: from Z to X is counterclockwise, seen from +Y.
TEST(KlartextWords, ArcsAreInThePlaneOfTheirPole) {
  const auto all = run_klartext_words(
      "L X+5 Y+1 Z+0 F100\nCC X+0 Z+0\nC X+0 Z+5 DR-\nCC Y+0 Z+0\nL Y+5 "
      "Z+0\nC Y+0 Z+5 DR+\n");
  const auto arcs = all_of<ArcFeed>(all);
  ASSERT_EQ(arcs.size(), 2U);
  EXPECT_EQ(arcs[0].plane, Plane::zx);
  EXPECT_EQ(arcs[0].turns, -1);
  EXPECT_EQ(arcs[1].plane, Plane::yz);
  EXPECT_EQ(arcs[1].turns, 1);
  EXPECT_EQ(*arcs[1].end[Z], 5.0);
}

// The shift of cycle 7 is one, whether it was set before the plane or ends in it.
TEST(KlartextFrames, AShiftThatEndsInATiltedPlaneDoesNotComeBack) {
  const std::string before =
      "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+50\nCYCL DEF 7.2 Y+20\nPLANE SPATIAL SPA+90 SPB+0 SPC+0 "
      "STAY\n";
  const std::string ends =
      "CYCL DEF 7.0 DATUM\nCYCL DEF 7.1 X+0\nCYCL DEF 7.2 Y+0\nCYCL DEF 7.3 "
      "Z+0\n";
  const std::string after = "PLANE RESET STAY\nL X+1 Y+2 Z+3 FMAX\n";
  expect_klartext_ends(before + after, {{51, 22, 3}});
  expect_klartext_ends(before + ends + after, {{1, 2, 3}});
  expect_klartext_ends(before + "CYCL DEF 7.1 X+0\n" + after, {{1, 22, 3}});
  const Event* told =
      klartext_event(run_klartext_words(before + ends + after), "datum-shift-in-plane");
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->grade, EventGrade::assumed);
  // One that was never set is none to end.
  EXPECT_EQ(
      klartext_event(run_klartext_words("PLANE SPATIAL SPA+90 SPB+0 SPC+0 STAY\n" + ends + after),
                     "datum-shift-in-plane"),
      nullptr);
}

TEST(KlartextFrames, TransformationsHaveWordsOfTheirOwn) {
  const std::string go = "L X+1 Y+2 FMAX\n";
  expect_klartext_ends("TRANS DATUM AXIS X+10 Y+5\n" + go, {{11, 7, -999}});
  expect_klartext_ends("TRANS DATUM AXIS X+10\nTRANS DATUM RESET\n" + go, {{1, 2, -999}});
  expect_klartext_ends("TRANS MIRROR AXIS X\n" + go, {{-1, 2, -999}});
  expect_klartext_ends("TRANS MIRROR AXIS X\nTRANS MIRROR RESET\n" + go, {{1, 2, -999}});
  expect_klartext_ends("TRANS ROTATION ROT+90\nL X+1 Y+2 Z+0 FMAX\n", {{-2, 1, 0}});
  expect_klartext_ends("TRANS SCALE SCL 2\n" + go, {{2, 4, -999}});
  EXPECT_EQ(last_of<WorkOffsetChange>(run_klartext_words("PRESET SELECT #3\n")).number, 3);
}

const std::string kSpindleOn = "TOOL CALL 1 Z S1000\nM3\n";

// M89 drills where each move ends, up to the move with M99.
TEST(KlartextWords, M89CallsACycleAfterEachMove) {
  const auto all =
      run_klartext_words(kSpindleOn +
                         "CYCL DEF 200 DRILLING Q200=+2 Q201=-5 Q206=+100 Q203=+0 Q204=+10\n"
                         "L X+0 Y+0 Z+10 FMAX M89\nL X+20 FMAX\nL X+40 FMAX M99\nL X+60 FMAX\n");
  std::vector<double> holes;
  for (const LinearFeed& feed : all_of<LinearFeed>(all)) holes.push_back(*feed.end[X]);
  EXPECT_EQ(holes, (std::vector<double>{0, 20, 40}));
  EXPECT_EQ(klartext_event(all, "M89")->grade, EventGrade::assumed);
  EXPECT_EQ(klartext_event(run_klartext_words("M89\n"), "M89")->grade, EventGrade::builder);
}

// Cycle 1: from where the tool is, SET UP above the surface; it stops 0.6 mm above the last depth.
TEST(KlartextWords, TheOldPeckingCycleCountsFromTheTool) {
  expect_klartext_ends(
      kSpindleOn +
          "CYCL DEF 1.0 PECKING\nCYCL DEF 1.1 SET UP -2\nCYCL DEF 1.2 DEPTH -5\nCYCL DEF "
          "1.3 PECKG -3\nCYCL DEF 1.4 DWELL 0\nCYCL DEF 1.5 F80\nL X+1 Y+2 Z+12 FMAX M99\n",
      {{1, 2, 12}, {1, 2, 7}, {1, 2, 12}, {1, 2, 7.6}, {1, 2, 5}, {1, 2, 12}});
}

TEST(KlartextWords, BoringLeavesTheWallBeforeItGoesBack) {
  expect_klartext_ends(
      kSpindleOn +
          "L X+1 Y+2 Z+50 FMAX\nCYCL DEF 202 BORING Q200=+2 Q201=-5 Q206=+100 Q211=+0 "
          "Q208=+250 Q203=+0 Q204=+20 Q214=1 Q336=+0\nCYCL CALL\n",
      {{1, 2, 50}, {1, 2, 2}, {1, 2, -5}, {0.8, 2, -5}, {0.8, 2, 2}, {0.8, 2, 20}, {1, 2, 20}});
}

// CYCL CALL POS names the place; its Z is a shift of the surface.
TEST(KlartextWords, ACycleIsCalledAtAPlace) {
  expect_klartext_ends(
      kSpindleOn +
          "L X+1 Y+2 Z+50 FMAX\nCYCL DEF 200 DRILLING Q200=+2 Q201=-5 Q206=+100 Q203=+0 "
          "Q204=+20\nCYCL CALL POS X+10 Y+20 Z-3\n",
      {{1, 2, 50}, {10, 20, 50}, {10, 20, -1}, {10, 20, -8}, {10, 20, 17}});
}

TEST(KlartextWords, PatternsCallTheCycleBefore) {
  const std::string drill =
      kSpindleOn +
      "L X+0 Y+0 Z+50 FMAX\nCYCL DEF 200 DRILLING Q200=+2 Q201=-5 Q206=+100 Q203=+0 "
      "Q204=+20\n";
  const auto holes = [](const std::string& text) {
    std::vector<Vec3> found;
    for (const LinearFeed& feed : all_of<LinearFeed>(run_klartext_words(text))) {
      found.emplace_back(*feed.end[X], *feed.end[Y], 0.0);
    }
    return found;
  };
  const auto ring = holes(drill +
                          "CYCL DEF 220 POLAR Q216=+50 Q217=+40 Q244=+20 Q245=+0 Q246=+360 "
                          "Q247=+0 Q241=+4 Q200=+2 Q203=+0 Q204=+20 Q301=1 Q365=0\n");
  ASSERT_EQ(ring.size(), 4U);
  EXPECT_LT((ring[1] - Vec3(50, 50, 0)).norm(), 1e-9);
  EXPECT_LT((ring[2] - Vec3(40, 40, 0)).norm(), 1e-9);
  // The second line comes back.
  const auto grid = holes(drill +
                          "CYCL DEF 221 ROWS Q225=+10 Q226=+20 Q237=+5 Q238=+7 Q242=+3 Q243=+2 "
                          "Q224=+0 Q200=+2 Q203=+0 Q204=+20 Q301=0\n");
  ASSERT_EQ(grid.size(), 6U);
  EXPECT_LT((grid[2] - Vec3(20, 20, 0)).norm(), 1e-9);
  EXPECT_LT((grid[3] - Vec3(20, 27, 0)).norm(), 1e-9);
  EXPECT_LT((grid[5] - Vec3(10, 27, 0)).norm(), 1e-9);
}

// The oversize of TOOL CALL adds to the radius of the tool.
TEST(KlartextWords, TheOversizeOfACallCountsBesideAContour) {
  InterpreterOptions options;
  options.tools[1].diameter = 10;
  const std::string path = "L X-30 Y-30 Z0 R0 FMAX\nL X+0 Y+0 RL F100\nL Y+50\nL X-50 R0\n";
  const auto first = [&](const std::string& call) {
    return *all_of<LinearFeed>(motions(call + path, options, Dialect::heidenhain))[0].end[X];
  };
  EXPECT_DOUBLE_EQ(first("TOOL CALL 1 Z S1\n"), -5.0);
  EXPECT_DOUBLE_EQ(first("TOOL CALL 1 Z S1 DR+0.5\n"), -5.5);
}

// Parameters in lines of their own, with or without marks; feeds by word.
TEST(KlartextWords, ParametersOfACycleMayFollowWithoutMarks) {
  const std::string go = kSpindleOn + "L X+1 Y+2 Z+50 FMAX\n";
  const std::vector<Vec3> expected{{1, 2, 50}, {1, 2, 2}, {1, 2, -5}, {1, 2, 20}};
  expect_klartext_ends(
      go + "CYCL DEF 200 DRILLING\nQ200=2\n Q201 = -5 ;DEPTH\nQ206=+100 ~\nQ203=+0\n"
           "Q204=+20\nCYCL CALL\n",
      expected);
  expect_klartext_ends(go + "CYCL DEF 200 DRILLING ~\nQ200=2 ~\nQ201=-5 ~\nQ206=+100 ~\nQ203=+0 ~\n"
                            "Q204=+20\nQ1=5\nCYCL CALL\n",
                       expected);
  const auto auto_feed = run_klartext_words(
      "TOOL CALL 1 Z S1 F250\nL X+1 Y+2 Z+50 FMAX\nCYCL DEF 203 Q200=2 Q201=-5 Q206=AUTO Q202=5 "
      "Q203=0 Q208=MAX\nM99\n");
  const auto feeds = all_of<LinearFeed>(auto_feed);
  ASSERT_EQ(feeds.size(), 1U);  // back by rapid
  EXPECT_EQ(feeds[0].feed.value, 250.0);
  EXPECT_NE(klartext_event(run_klartext_words("CYCL DEF 392 ATC~\nQ240=0 ;MODE~\nQ241=1 ;WEIGHT\n"),
                           "CYCL DEF 392"),
            nullptr);
}

TEST(KlartextWords, TurningIsNotMilling) {
  for (const char* text : {"FUNCTION MODE TURN\n", "CYCL DEF 811 SHOULDER\n"}) {
    const auto ids = complaint_ids(text, {}, Dialect::heidenhain);
    ASSERT_EQ(ids.size(), 1U) << text;
    EXPECT_EQ(ids[0], "not-milling") << text;
  }
}

}  // namespace
}  // namespace frustum::parser
