// APPR and DEP of Klartext: ways on to a contour and off it, with points derived by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

constexpr double kTinyWay = 1e-9;

// Tool 1 has the diameter.
std::vector<Motion> run_approach(const std::string& text, double diameter) {
  InterpreterOptions options;
  options.tools[1].diameter = diameter;
  return motions(text, options, Dialect::heidenhain);
}
struct Move {
  Vec3 end;
  int turns = 0;
  Vec3 centre = Vec3::Zero();
  double feed = 0.0;  // 0: by rapid
};
std::vector<Move> moves_of(const std::vector<Motion>& all) {
  const auto point = [](const AxisTarget& end) {
    return Vec3(end[X].value_or(-999), end[Y].value_or(-999), end[Z].value_or(-999));
  };
  std::vector<Move> found;
  for (const Motion& motion : all) {
    if (const auto* rapid = std::get_if<Traverse>(&motion.command)) {
      found.push_back({point(rapid->end)});
    } else if (const auto* feed = std::get_if<LinearFeed>(&motion.command)) {
      found.push_back({point(feed->end), 0, Vec3::Zero(), feed->feed.value});
    } else if (const auto* arc = std::get_if<ArcFeed>(&motion.command)) {
      found.push_back({point(arc->end), arc->turns, arc->center, arc->feed.value});
    }
  }
  return found;
}
void expect_moves(const std::vector<Move>& found, const std::vector<Move>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_LT((found[i].end - expected[i].end).norm(), kTinyWay)
        << i << ": " << found[i].end.transpose() << " for " << expected[i].end.transpose();
    EXPECT_EQ(found[i].turns, expected[i].turns) << i;
    if (expected[i].turns != 0) {
      EXPECT_LT((found[i].centre - expected[i].centre).norm(), kTinyWay)
          << i << ": " << found[i].centre.transpose();
    }
    EXPECT_EQ(found[i].feed, expected[i].feed) << i;
  }
}

const std::string kStart = "TOOL CALL 1 Z S1000\nL X-40 Y-30 Z-5 R0 FMAX\n";

// The contour goes up along X0; the tool, of radius 4, is left of it.
TEST(KlartextApproach, GoesAlongTheFirstMoveOfTheContour) {
  expect_moves(moves_of(run_approach(kStart + "APPR LT X+0 Y+0 LEN10 RL F200\nL Y+50\n"
                                              "DEP LT LEN12 F500\nL Z+50 R0 FMAX\n",
                                     8)),
               {{{-40, -30, -5}},
                {{-4, -10, -5}},
                {{-4, 0, -5}, 0, {}, 200},
                {{-4, 50, -5}, 0, {}, 200},
                {{-4, 62, -5}, 0, {}, 500},
                {{-4, 62, 50}}});
}

TEST(KlartextApproach, GoesAcrossTheContourFromTheSideOfTheTool) {
  expect_moves(moves_of(run_approach(kStart + "APPR LN X+0 Y+0 LEN10 RL F200\nL Y+50\n"
                                              "DEP LN LEN12 F500\nL IX-1 FMAX\n",
                                     8)),
               {{{-40, -30, -5}},
                {{-14, 0, -5}},
                {{-4, 0, -5}, 0, {}, 200},
                {{-4, 50, -5}, 0, {}, 200},
                {{-16, 50, -5}, 0, {}, 500},
                {{-17, 50, -5}}});
}

// R is the radius of the way of the tool's centre; RL with R above zero turns counterclockwise.
TEST(KlartextApproach, TouchesTheContourByAnArc) {
  expect_moves(moves_of(run_approach(kStart + "APPR CT X+0 Y+0 CCA90 R+6 RL F200\nL Y+50\n"
                                              "DEP CT CCA180 R+6 F500\n",
                                     8)),
               {{{-40, -30, -5}},
                {{-10, -6, -5}},
                {{-4, 0, -5}, 1, {-10, 0, -5}, 200},
                {{-4, 50, -5}, 0, {}, 200},
                {{-16, 50, -5}, 1, {-10, 50, -5}, 500}});
  // On the other side of the contour, clockwise.
  expect_moves(moves_of(run_approach(kStart + "APPR CT X+0 Y+0 CCA90 R-6 RL F200\nL Y+50\nDEP LT "
                                              "LEN1\n",
                                     8)),
               {{{-40, -30, -5}},
                {{2, -6, -5}},
                {{-4, 0, -5}, -1, {2, 0, -5}, 200},
                {{-4, 50, -5}, 0, {}, 200},
                {{-4, 51, -5}, 0, {}, 200}});
}

// The line from the start touches the arc, which touches the contour. The arc's radius may be below
// that of the tool, as in the example of the control's manual.
TEST(KlartextApproach, GoesByALineIntoAnArc) {
  const auto found = moves_of(run_approach(
      kStart + "APPR LCT X+5 Y+5 R5 RL F300\nL Y+85\nDEP LCT X-20 Y+120 R5 F1000\n", 20));
  ASSERT_EQ(found.size(), 6U);
  const Vec3 centre(-10, 5, -5);
  EXPECT_LT((found[2].end - Vec3(-5, 5, -5)).norm(), kTinyWay);
  EXPECT_EQ(found[2].turns, 1);
  EXPECT_LT((found[2].centre - centre).norm(), kTinyWay);
  const Vec3 touch = found[1].end;
  EXPECT_NEAR((touch - centre).norm(), 5.0, kTinyWay);
  EXPECT_NEAR((touch - centre).dot(touch - found[0].end), 0.0, 1e-6);
  EXPECT_EQ(found[1].feed, 300.0);
  EXPECT_LT((found[3].end - Vec3(-5, 85, -5)).norm(), kTinyWay);
  const Vec3 leaving = found[4].end;
  EXPECT_EQ(found[4].turns, 1);
  EXPECT_LT((found[4].centre - Vec3(-10, 85, -5)).norm(), kTinyWay);
  EXPECT_NEAR((leaving - found[4].centre).dot(found[5].end - leaving), 0.0, 1e-6);
  EXPECT_GT(Vec3::UnitZ().cross(leaving - found[4].centre).dot(found[5].end - leaving), 0.0);
  EXPECT_LT((found[5].end - Vec3(-20, 120, -5)).norm(), kTinyWay);
}

TEST(KlartextApproach, TakesPolarPlacesAndRightHandContours) {
  expect_moves(moves_of(run_approach(kStart + "CC X+0 Y+0\nAPPR PLT PR+20 PA+180 LEN10 RR F200\n"
                                              "L Y+50\nDEP PLCT PR+90 PA+90 R3 F500\n",
                                     8)),
               {{{-40, -30, -5}},
                {{-16, -10, -5}},
                {{-16, 0, -5}, 0, {}, 200},
                {{-16, 50, -5}, 0, {}, 200},
                moves_of(run_approach(kStart + "APPR LT X-20 Y+0 LEN10 RR F200\nL Y+50\n"
                                               "DEP LCT X+0 Y+90 R3 F500\n",
                                      8))[4],
                {{0, 90, -5}, 0, {}, 500}});
}

TEST(KlartextApproach, GoesDownWhereItBeginsAndSaysSo) {
  const auto all = run_approach(
      "TOOL CALL 1 Z S1000\nL X-40 Y-30 Z+5 R0 F900\nAPPR LT X+0 Y+0 Z-5 LEN10 RL F200\nL Y+50\n"
      "DEP LT LEN12 Z+3\n",
      8);
  expect_moves(moves_of(all), {{{-40, -30, 5}, 0, {}, 900},
                               {{-4, -10, 5}, 0, {}, 900},
                               {{-4, -10, -5}, 0, {}, 900},
                               {{-4, 0, -5}, 0, {}, 200},
                               {{-4, 50, -5}, 0, {}, 200},
                               {{-4, 62, -5}, 0, {}, 200},
                               {{-4, 62, 3}, 0, {}, 200}});
  int assumed = 0;
  for (const Event& event : all_of<Event>(all)) assumed += event.grade == EventGrade::assumed;
  EXPECT_EQ(assumed, 2);
}

TEST(KlartextApproach, LeadsIntoContoursOfArcsAndCorners) {
  // A circle about the origin, clockwise from X-20, the tool outside, left of it.
  expect_moves(moves_of(run_approach(kStart + "CC X+0 Y+0\nAPPR LT X-20 Y+0 LEN10 RL F200\n"
                                              "C X-20 Y+0 DR-\nDEP LT LEN5\n",
                                     8)),
               {{{-40, -30, -5}},
                {{-24, -10, -5}},
                {{-24, 0, -5}, 0, {}, 200},
                {{-24, 0, -5}, -1, {0, 0, -5}, 200},
                {{-24, 5, -5}, 0, {}, 200}});
}

TEST(KlartextApproach, SaysWhatIsMissing) {
  const auto complaint = [](const std::string& text) {
    InterpreterOptions options;
    options.tools[1].diameter = 8;
    const auto lines = complaints(text, options, Dialect::heidenhain);
    return lines.empty() ? std::string() : lines.front();
  };
  struct Wrong {
    std::string text;
    std::string complaint;
  };
  for (const Wrong& wrong : std::vector<Wrong>{
           {kStart + "APPR LT X+0 Y+0 LEN0 RL F200\n", "3:17: error: LEN0 is not above zero"},
           {kStart + "APPR CT X+0 Y+0 R5 RL F200\n", "3:1: error: APPR CT without CCA"},
           {kStart + "APPR LCT X+0 Y+0 RL F200\n", "3:1: error: APPR LCT without R"},
           {kStart + "APPR CT X+0 Y+0 CCA400 R5 RL F200\n", "3:17: error: CCA400 is out of range"},
           {kStart + "APPR XX X+0\n", "3:6: error: APPR does not say how"},
           {kStart + "APPR LT X+0 Y+0 LEN5 RL F200\nTOOL CALL 2 Z\n",
            "4:1: error: TOOL CALL with radius compensation on"},
           {kStart + "APPR LT X+0 Y+0 LEN5 R0 F200\nTOOL CALL 2 Z\n",
            "4:1: error: TOOL CALL between APPR LT and the contour"},
           {kStart + "APPR LT X+0 Y+0 LEN5 RL F200\nM30\n",
            "4:1: error: M30 between APPR LT and the contour"},
           {kStart + "APPR LT X+0 Y+0 LEN5 RL F200\n",
            "3:1: error: APPR LT with no contour after it"},
           {kStart + "APPR LCT X-20 Y-28 R50 RL F200\nL Y+50\n",
            "3:1: error: APPR LCT begins within the circle of its arc"},
           {"TOOL CALL 1 Z\nDEP LT LEN5 F100\n", "2:1: error: DEP LT leaves no contour"},
           {kStart + "L X+0 F100\nDEP LN LEN5\n", "4:1: error: DEP LN without radius compensation"},
       }) {
    EXPECT_TRUE(complaint(wrong.text).starts_with(wrong.complaint)) << complaint(wrong.text) << "\n"
                                                                    << wrong.text;
  }
}

// Without a diameter the contour itself is the path where the options say so, and an event tells.
TEST(KlartextApproach, GoesAlongTheContourOfAToolWithoutDiameter) {
  const std::string text =
      kStart + "APPR CT X+0 Y+0 CCA90 R+6 RL F200\nL Y+50\nDEP LN LEN12\nL X+0 Y+0 R0 FMAX\n";
  EXPECT_FALSE(failures_of(text, {}, Dialect::heidenhain).empty());
  InterpreterOptions options;
  options.contours_without_diameter = true;
  const auto all = motions(text, options, Dialect::heidenhain);
  expect_moves(moves_of(all), {{{-40, -30, -5}},
                               {{-6, -6, -5}},
                               {{0, 0, -5}, 1, {-6, 0, -5}, 200},
                               {{0, 50, -5}, 0, {}, 200},
                               {{-12, 50, -5}, 0, {}, 200},
                               {{0, 0, -5}}});
  bool told = false;
  for (const Event& event : all_of<Event>(all)) {
    told = told || (event.name == "contour-without-diameter" && event.grade == EventGrade::assumed);
  }
  EXPECT_TRUE(told);
}

}  // namespace
}  // namespace frustum::parser
