// PATTERN DEF and CYCL CALL PAT of Klartext, and taps in steps.
#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "parser/interpret/moves/plane_path.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run_points(const std::string& text) {
  return motions(text, {}, Dialect::heidenhain);
}
// Where the moves end; -999 for an axis that is not known.
std::vector<Vec3> ends_at_points(const std::vector<Motion>& all) {
  std::vector<Vec3> found;
  for (const Motion& motion : all) {
    const AxisTarget* end = nullptr;
    if (const auto* rapid = std::get_if<Traverse>(&motion.command)) end = &rapid->end;
    if (const auto* feed = std::get_if<LinearFeed>(&motion.command)) end = &feed->end;
    if (end == nullptr) continue;
    found.emplace_back((*end)[X].value_or(-999), (*end)[Y].value_or(-999),
                       (*end)[Z].value_or(-999));
  }
  return found;
}
void expect_ends_at_points(const std::string& text, const std::vector<Vec3>& expected) {
  const auto found = ends_at_points(run_points(text));
  ASSERT_EQ(found.size(), expected.size()) << text;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT((found[i] - expected[i]).norm(), 1e-9) << i << ": " << found[i].transpose();
  }
}

const std::string kTool = "TOOL CALL 1 Z S1000\n";
const std::string kDrillAt10 = "CYCL DEF 200 Q200=2 Q201=-5 Q206=100 Q202=9 Q203=+10 Q204=20\n";

// The places that are drilled: where a feed ends.
void expect_holes(const std::string& pattern, const std::vector<Vec2>& expected) {
  std::vector<Vec2> found;
  const std::string go = kTool + "L X+0 Y+0 Z+50 FMAX\n" + kDrillAt10;
  for (const Motion& motion : run_points(go + "PATTERN DEF " + pattern + "\nCYCL CALL PAT\n")) {
    const auto* feed = std::get_if<LinearFeed>(&motion.command);
    if (feed != nullptr) found.emplace_back(*feed->end[X], *feed->end[Y]);
  }
  ASSERT_EQ(found.size(), expected.size()) << pattern;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT((found[i] - expected[i]).norm(), 1e-9)
        << pattern << " " << i << ": " << found[i].transpose();
  }
}

TEST(KlartextPoints, AreDrilledAsHighAsTheToolWasBetweenThem) {
  // The surface is at 10, at the second point 4 lower.
  expect_ends_at_points(kTool + "L X+0 Y+0 Z+50 FMAX\n" + kDrillAt10 +
                            "PATTERN DEF ~\n  POS1( X+25 Y+33,5 Z+0 ) ~\n  POS2( X+50 Y+75 Z-4 )\n"
                            "CYCL CALL PAT FMAX M3\n",
                        {{0, 0, 50},
                         {25, 33.5, 50},
                         {25, 33.5, 12},
                         {25, 33.5, 5},
                         {25, 33.5, 50},
                         {50, 75, 50},
                         {50, 75, 8},
                         {50, 75, 1},
                         {50, 75, 26}});
}

TEST(KlartextPoints, AreGoneOverFirstWhereXAndYAreUnknown) {
  expect_ends_at_points(
      kTool + "L Z+50 FMAX\n" + kDrillAt10 + "PATTERN DEF POS1 (X+5 Y+6)\nCYCL CALL PAT\n",
      {{-999, -999, 50}, {5, 6, 50}, {5, 6, 12}, {5, 6, 5}, {5, 6, 30}});
  expect_ends_at_points(kTool + "L Z+50 FMAX\n" + kDrillAt10 + "CYCL CALL POS X+5 Y+6 Z+0\n",
                        {{-999, -999, 50}, {5, 6, 50}, {5, 6, 12}, {5, 6, 5}, {5, 6, 30}});
}

TEST(KlartextPoints, HaveSixKinds) {
  expect_holes("ROW1 (X+1 Y+2 D+8 NUM3 ROT+90 Z+0)", {{1, 2}, {1, 10}, {1, 18}});
  expect_holes("PAT1 (X+0 Y+0 DX+10 DY+5 NUMX3 NUMY2 ROT+0 ROTX+0 ROTY+0 Z+0)",
               {{0, 0}, {10, 0}, {20, 0}, {20, 5}, {10, 5}, {0, 5}});
  // The whole by 90 degrees; then the lines alone.
  expect_holes("PAT1 (X+0 Y+0 DX+10 DY+5 NUMX2 NUMY2 ROT+90)",
               {{0, 0}, {0, 10}, {-5, 10}, {-5, 0}});
  expect_holes("PAT1 (X+0 Y+0 DX+10 DY+5 NUMX2 NUMY2 ROTX+90)", {{0, 0}, {0, 10}, {0, 15}, {0, 5}});
  expect_holes("PAT1 (X+0 Y+0 DX+10 DY+5 NUMX2 NUMY2 ROTY-90)", {{0, 0}, {10, 0}, {15, 0}, {5, 0}});
  expect_holes("FRAME1 (X+0 Y+0 DX+10 DY+5 NUMX3 NUMY3 ROT+0)",
               {{0, 0}, {10, 0}, {20, 0}, {20, 5}, {20, 10}, {10, 10}, {0, 10}, {0, 5}});
  expect_holes("CIRC1 (X+5 Y+0 D20 START+90 NUM4)", {{5, 10}, {-5, 0}, {5, -10}, {15, 0}});
  expect_holes("PITCHCIRC1 (X+0 Y+0 D20 START+0 STEP-90 NUM3)", {{10, 0}, {0, -10}, {-10, 0}});
  expect_holes("PITCHCIRC1 (X+0 Y+0 D20 START+0 END+180 NUM3)", {{10, 0}, {0, 10}, {-10, 0}});
  expect_holes("POS1 (X+1 Y+2) ROW2 (X+5 Y+5 D-1 NUM2)", {{1, 2}, {5, 5}, {4, 5}});
}

TEST(KlartextPoints, TakeParameters) {
  const std::string go = kTool + "L X+0 Y+0 Z+50 FMAX\n" + kDrillAt10;
  const auto all =
      run_points(go + "Q5 = 3\nPATTERN DEF ROW1 (XQ5 Y-Q5 D+Q5 NUMQ5)\nCYCL CALL PAT\n");
  EXPECT_LT((ends_at_points(all).back() - Vec3(9, -3, 30)).norm(), 1e-9);
}

TEST(KlartextPoints, AreRefusedWhereTheySayNothing) {
  const std::string go = kTool + "L X+0 Y+0 Z+50 FMAX\n" + kDrillAt10;
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {"PATTERN DEF\n", "1:1: error: PATTERN DEF has no points"},
           {"PATTERN DEF POS1 X+1 Y+2\n", "1:18: error: the opening bracket is missing"},
           {"PATTERN DEF POS1 (X+1)\n", "1:13: error: POS1 has no Y"},
           {"PATTERN DEF POS1 (X+1 Y+2 D+3)\n", "1:27: error: D has no meaning in POS1"},
           {"PATTERN DEF POS (X+1 Y+2)\n", "1:13: error: POS is no pattern of points"},
           {"PATTERN DEF POS1 (X+1 X+2)\n", "1:23: error: X is given twice"},
           {"PATTERN DEF POS1 (X+1 Y+2\n", "1:13: error: the bracket is not closed"},
           {"PATTERN DEF ROW1 (X+1 Y+2 D+3 NUM0)\n", "1:1: error: NUM of ROW1 is 0"},
           {"PATTERN DEF PAT1 (X+1 Y+2 DX+3 DY+3 NUMX9000 NUMY9000)\n",
            "1:1: error: PAT1 has 9000 times 9000 points"},
           {"PATTERN DEF PITCHCIRC1 (X+1 Y+2 D+3 NUM4)\n",
            "1:1: error: PITCHCIRC1 has neither STEP nor END, or both"},
           {go + "CYCL CALL PAT\n", "4:1: error: CYCL CALL PAT without points"},
           {"CYCL DEF 12.1 PGM SLOT\nCYCL CALL POS X+1 Y+1 Z+0\n",
            "2:1: error: CYCL CALL POS of a program (CYCL DEF 12) is not simulated"}}) {
    const auto wrong = complaints(text, {}, Dialect::heidenhain);
    ASSERT_FALSE(wrong.empty()) << text;
    EXPECT_TRUE(wrong.front().starts_with(expected)) << wrong.front() << "\n" << text;
  }
}

TEST(KlartextTap, GoesBackAtEachStep) {
  const std::string go = "TOOL CALL 1 Z S100\nL X+0 Y+0 Z+12 FMAX M3\n";
  const std::string tap = "Q200=2 Q201=-10 Q239=+1.5 Q203=+10 Q204=20 Q257=4 ";
  // By one pitch; out of the hole.
  expect_ends_at_points(go + "CYCL DEF 209 " + tap + "Q256=+1 Q336=50\nCYCL CALL\n", {{0, 0, 12},
                                                                                      {0, 0, 6},
                                                                                      {0, 0, 7.5},
                                                                                      {0, 0, 2},
                                                                                      {0, 0, 3.5},
                                                                                      {0, 0, 0},
                                                                                      {0, 0, 12},
                                                                                      {0, 0, 30}});
  expect_ends_at_points(go + "CYCL DEF 209 " + tap + "Q256=+0 Q336=50\nCYCL CALL\n", {{0, 0, 12},
                                                                                      {0, 0, 6},
                                                                                      {0, 0, 12},
                                                                                      {0, 0, 2},
                                                                                      {0, 0, 12},
                                                                                      {0, 0, 0},
                                                                                      {0, 0, 12},
                                                                                      {0, 0, 30}});
}

TEST(KlartextTap, OfOlderControlsHasAPitch) {
  const auto all = run_points(
      "TOOL CALL 1 Z S100\nL X+0 Y+0 Z+12 FMAX M3\nCYCL DEF 17.0 RIGID TAPPING\nCYCL DEF 17.1 SET "
      "UP -2\nCYCL DEF 17.2 DEPTH -8\nCYCL DEF 17.3 PITCH +1.25\nCYCL CALL\n");
  const auto ends = ends_at_points(all);
  ASSERT_EQ(ends.size(), 3);
  EXPECT_LT((ends[1] - Vec3(0, 0, 2)).norm(), 1e-9);
  EXPECT_LT((ends[2] - Vec3(0, 0, 12)).norm(), 1e-9);
  EXPECT_EQ(last_of<LinearFeed>(all).feed.value, 1.25);
  EXPECT_EQ(last_of<LinearFeed>(all).feed.mode, FeedMode::per_revolution);
}

TEST(KlartextSingleLip, GoesDownInOneStrokeAndBackByItsFeed) {
  const std::string go = "TOOL CALL 1 Z S100\nL X+0 Y+0 Z+12 FMAX M3\nQ5 = 25\n";
  const std::string cycle =
      "CYCL DEF 241 Q200=2 Q201=-80 Q206=150 Q211=1 Q203=+10 Q204=20 Q379=0 Q253=MAX Q208=1000 "
      "Q426=3 Q427=Q5 Q428=+500 Q429=8 Q430=9 Q435=0 ";
  const auto all = run_points(go + cycle + "Q202=99999\nCYCL CALL\n");
  const auto feeds = all_of<LinearFeed>(all);
  ASSERT_EQ(feeds.size(), 2);
  EXPECT_EQ(feeds[0].end[Z], -70);
  EXPECT_EQ(feeds[0].feed.value, 150);
  EXPECT_EQ(feeds[1].end[Z], 12);
  EXPECT_EQ(feeds[1].feed.value, 1000);
  const auto wrong = complaints("CYCL DEF 241 Q200=2 Q201=-80 Q206=150 Q203=+10 Q202=5\n", {},
                                Dialect::heidenhain);
  ASSERT_FALSE(wrong.empty());
  EXPECT_TRUE(wrong.front().starts_with("1:48: error: Q202=5 of CYCL DEF 241 is not simulated"))
      << wrong.front();
}

TEST(KlartextRetraction, IsByRapidWhereItsFeedIsTheFastest) {
  const auto all = run_points(
      "TOOL CALL 1 Z S100\nL X+0 Y+0 Z+2 FMAX\nCYCL DEF 201 Q200=2 Q201=-5 Q206=100 Q208=MAX "
      "Q203=0 Q204=20\nCYCL CALL\n");
  EXPECT_EQ(all_of<LinearFeed>(all).size(), 1);
  EXPECT_LT((ends_at_points(all)[2] - Vec3(0, 0, 2)).norm(), 1e-9);
}

TEST(KlartextConditions, AskWhetherAParameterIsSet) {
  const std::string jump = " GOTO LBL 1\nL X+1 FMAX\nLBL 1\nL X+2 FMAX\n";
  const auto moves = [&](const std::string& text) {
    return all_of<Traverse>(run_points(text + jump)).size();
  };
  EXPECT_EQ(moves("FN 9: IF Q1 IS UNDEFINED"), 1);
  EXPECT_EQ(moves("FN 9: IF Q1 IS DEFINED"), 2);
  EXPECT_EQ(moves("Q1 = 0\nFN 9: IF Q1 IS UNDEFINED"), 2);
  EXPECT_EQ(moves("Q1 = 0\nFN 9: IF +Q1 IS DEFINED"), 1);
  for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
           {"FN 9: IF +5 IS DEFINED GOTO LBL 1\n", "1:13: error: IS asks whether"},
           {"FN 9: IF Q1 IS THERE GOTO LBL 1\n", "1:13: error: IS asks whether"},
           {"Q1 = 0\nFN 9: IF +Q1 NE +5 GOTO LBL 1\n",
            "2:14: error: NE is not the comparison of this FN"}}) {
    const auto wrong = complaints(text, {}, Dialect::heidenhain);
    ASSERT_FALSE(wrong.empty()) << text;
    EXPECT_TRUE(wrong.front().starts_with(expected)) << wrong.front();
  }
}

TEST(KlartextWords, OfTheSpindleAndOfOtherCyclesMoveNothing) {
  const auto all = run_points(
      "GLOBAL DEF 100 GENERAL Q200=2 ~\n  Q204=50\nMONITORING HEATMAP SELECTED\nCYCL DEF 13.0 "
      "ORIENTATION\nCYCL DEF 13.1 ANGLE 180\n");
  const auto events = all_of<Event>(all);
  ASSERT_EQ(events.size(), 4);
  EXPECT_EQ(events[0].name, "GLOBAL DEF");
  EXPECT_EQ(events[0].text, "100 GENERAL Q200=2 Q204=50");
  EXPECT_EQ(events[3].name, "CYCL DEF 13");
  EXPECT_FALSE(complaints("GLOBAL DEF 125 POSITIONING Q345=+1\n", {}, Dialect::heidenhain).empty());
}

}  // namespace
}  // namespace frustum::parser
