// Klartext: paths, datums, cycles and parameters, with motions derived by hand, and what is wrong
//           with statements.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "parser/writing/canonical_json.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

constexpr double kTiny = 1e-9;

std::vector<Motion> run_klartext(const std::string& text) {
  return motions(text, {}, Dialect::heidenhain);
}

Vec3 end_of(const AxisTarget& end) {
  return {end[X].value_or(-999.0), end[Y].value_or(-999.0), end[Z].value_or(-999.0)};
}
// The ends of all moves, in program coordinates.
std::vector<Vec3> places(const std::vector<Motion>& motions) {
  std::vector<Vec3> found;
  for (const Motion& motion : motions) {
    if (const auto* rapid = std::get_if<Traverse>(&motion.command)) {
      found.push_back(end_of(rapid->end));
    } else if (const auto* feed = std::get_if<LinearFeed>(&motion.command)) {
      found.push_back(end_of(feed->end));
    } else if (const auto* arc = std::get_if<ArcFeed>(&motion.command)) {
      found.push_back(end_of(arc->end));
    }
  }
  return found;
}
void expect_same(const std::vector<Vec3>& a, const std::vector<Vec3>& b, double tolerance = kTiny) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_LT((a[i] - b[i]).norm(), tolerance)
        << i << ": " << a[i].transpose() << " and " << b[i].transpose();
  }
}
std::string complaint(const std::string& text) {
  const auto lines = complaints(text, {}, Dialect::heidenhain);
  return lines.empty() ? std::string() : lines.front();
}

// --- paths ---------------------------------------------------------------------------------------

TEST(KlartextPaths, ArePolarAboutThePole) {
  const auto found = places(run_klartext(
      "CC X+10 Y+20\nLP PR+5 PA+0 FMAX\nL Z+0 FMAX\nLP PA+90 F100\nLP IPA+90\nLP IPR+5\n"
      "LP PR+2 PA-90\n"));
  expect_same(found,
              {{15, 20, -999}, {15, 20, 0}, {10, 25, 0}, {5, 20, 0}, {0, 20, 0}, {10, 18, 0}});
}

TEST(KlartextPaths, TurnAboutThePoleByAnAngle) {
  const auto all = run_klartext(
      "L X+15 Y+20 Z+5 FMAX\nCC X+10 Y+20\nCP PA+90 DR+ F100\nCP PA+0 DR+\n"
      "CP IPA-1080 IZ-6 DR-\nCP IPA-405 DR-\n");
  const auto arcs = all_of<ArcFeed>(all);
  ASSERT_EQ(arcs.size(), 4U);
  expect_same(places(all), {{15, 20, 5},
                            {10, 25, 5},
                            {15, 20, 5},
                            {15, 20, -1},
                            {10 + 5 * std::sqrt(0.5), 20 - 5 * std::sqrt(0.5), -1}});
  EXPECT_EQ(arcs[0].turns, 1);
  EXPECT_EQ(arcs[1].turns, 1);
  EXPECT_EQ(arcs[2].turns, -3);
  EXPECT_EQ(arcs[3].turns, -2);
  for (const ArcFeed& arc : arcs)
    EXPECT_LT((arc.center - Vec3(10, 20, arc.center[2])).norm(), kTiny);
}

TEST(KlartextPaths, LeadOnTangentially) {
  // Along X, then a quarter to the left and a half to the right; straight, and on about the corner.
  const auto arcs = all_of<ArcFeed>(run_klartext(
      "L X+0 Y+0 Z+0 FMAX\nL X+10 F100\nCT X+15 Y+5\nCT IX+6 IY+0\nL IY-4\nCC IX+0 IY+0\n"
      "CTP PR+2 PA+0\n"));
  ASSERT_EQ(arcs.size(), 3U);
  EXPECT_LT((arcs[0].center - Vec3(10, 5, 0)).norm(), kTiny);
  EXPECT_EQ(arcs[0].turns, 1);
  EXPECT_LT((arcs[1].center - Vec3(18, 5, 0)).norm(), kTiny);
  EXPECT_EQ(arcs[1].turns, -1);
  EXPECT_LT((end_of(arcs[2].end) - Vec3(23, 1, 0)).norm(), kTiny);
  EXPECT_LT((arcs[2].center - Vec3(22, 1, 0)).norm(), kTiny);
  EXPECT_EQ(arcs[2].turns, 1);
  // On from a circle: its last tangent. (10 0) about the origin to (0 10) ends along -X.
  const auto behind = last_of<ArcFeed>(
      run_klartext("L X+10 Y+0 Z+0 FMAX\nCC X+0 Y+0\nC X+0 Y+10 DR+ F9\nCT X-5 Y+15\n"));
  EXPECT_LT((behind.center - Vec3(0, 15, 0)).norm(), kTiny);
  EXPECT_EQ(behind.turns, -1);
}

TEST(KlartextPaths, CloseFullCirclesAndCountFromTheTool) {
  const auto circle =
      last_of<ArcFeed>(run_klartext("L X+5 Y+0 Z+0 FMAX\nCC IX-5 IY+0\nC X+5 Y+0 DR- F50\n"));
  EXPECT_LT(circle.center.norm(), kTiny);
  EXPECT_EQ(circle.turns, -1);
  EXPECT_EQ(circle.end[X], 5.0);
}

// The same places by X and Y and by PR and PA.
TEST(KlartextLaws, PolarWordsAreTheirCartesianPlaces) {
  std::mt19937 dice(7);
  std::uniform_real_distribution<double> angle(-720.0, 720.0);
  std::uniform_real_distribution<double> radius(0.1, 80.0);
  for (int i = 0; i < 200; ++i) {
    const double a = angle(dice);
    const double r = radius(dice);
    const std::string start = "L X+0 Y+0 Z+0 FMAX\nCC X+3 Y-4\n";
    const auto polar = places(run_klartext(start + "LP PR+" + std::to_string(r) + " PA" +
                                           (a < 0 ? "" : "+") + std::to_string(a) + " FMAX\n"));
    const double rounded_r = std::stod(std::to_string(r));
    const double rounded_a = std::stod(std::to_string(a)) * kRadPerDeg;
    expect_same(polar,
                {{0, 0, 0},
                 {3 + rounded_r * std::cos(rounded_a), -4 + rounded_r * std::sin(rounded_a), 0}});
  }
}

// --- datums --------------------------------------------------------------------------------------

TEST(KlartextDatums, AreShiftedByCycle7) {
  expect_same(
      places(run_klartext("L X+0 Y+0 Z+0 FMAX\nCYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+60\n"
                          "CYCL DEF 7.2 Y+40\nL X+1 Y+1 FMAX\nCYCL DEF 7.0 DATUM SHIFT\n"
                          "CYCL DEF 7.1 IX-10 Z+5\nL X+1 Y+1 Z+0 FMAX\nCYCL DEF 7.1 X+0 Y+0 Z+0\n"
                          "L X+1 FMAX\n")),
      {{0, 0, 0}, {61, 41, 0}, {51, 41, 5}, {1, 41, 5}});
  // By parameters.
  expect_same(places(run_klartext("Q1 = 5\nCYCL DEF 7.1 X+Q1 Y-Q1 Z+0\nL X+1 Y+1 Z+1 FMAX\n")),
              {{6, -4, 1}});
}

TEST(KlartextDatums, AreTurnedByCycle10AboutTheShiftedDatum) {
  expect_same(places(run_klartext(
                  "CYCL DEF 7.1 X+10 Y+0 Z+0\nCYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 ROT+90\n"
                  "L X+5 Y+1 Z+2 FMAX\nCYCL DEF 10.1 IROT+90\nL X+5 Y+1 FMAX\n"
                  "CYCL DEF 10.1 ROT+0\nL X+5 Y+1 FMAX\n")),
              {{9, 5, 2}, {5, -1, 2}, {15, 1, 2}});
}

// Cycle 10 is its words turned by hand; arcs too.
TEST(KlartextLaws, ARotationIsItsWordsTurnedByHand) {
  for (const double angle : {0.0, 30.0, 90.0, -37.5, 180.0, 359.0}) {
    const double c = std::cos(angle * kRadPerDeg);
    const double s = std::sin(angle * kRadPerDeg);
    const std::vector<Vec3> words{{10, 0, 5}, {12, 3, 5}, {12, 7, 1}, {8, 7, 1}, {-4, -4, 0}};
    std::string turned =
        "CYCL DEF 10.1 ROT" + std::string(angle < 0 ? "" : "+") + std::to_string(angle) + "\n";
    std::vector<Vec3> expected;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const Vec3& w = words[i];
      const auto word = [](const char* letter, double value) {
        return std::string(letter) + (value < 0 ? "" : "+") + std::to_string(value);
      };
      turned += (i == 3 ? "CR " : "L ") + word("X", w[0]) + word(" Y", w[1]) + word(" Z", w[2]) +
                (i == 0   ? " FMAX"
                 : i == 3 ? " R+2.5 DR+ F100"
                          : " F100") +
                "\n";
      expected.emplace_back(c * w[0] - s * w[1], s * w[0] + c * w[1], w[2]);
    }
    expect_same(places(run_klartext(turned)), expected);
  }
}

TEST(KlartextLaws, RepeatsAreTheirBlocksWrittenOut) {
  const std::string body = "CYCL DEF 7.1 IX+10\nL X+1 Y+2 FMAX\nCC X+0 Y+0\nLP PR+5 PA+30 FMAX\n";
  std::string written = "L X+0 Y+0 Z+0 FMAX\n";
  const std::string repeated = written + "LBL 1\n" + body + "CALL LBL 1 REP 3\n";
  for (int i = 0; i < 4; ++i) written += body;
  expect_same(places(run_klartext(repeated)), places(run_klartext(written)));
}

TEST(KlartextDatums, AreMirroredAndScaledAboutTheShiftedDatum) {
  const auto all = run_klartext(
      "CYCL DEF 7.1 X+10 Y+0 Z+0\nCYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 X\n"
      "L X+5 Y+1 Z+2 FMAX\nCC X+5 Y+3\nC X+5 Y+5 DR+ F9\nCYCL DEF 8.1 Y\n"
      "L X+5 Y+1 FMAX\nCYCL DEF 8.1\nCYCL DEF 11.1 SCL 0.5\nL X+4 Y+2 Z+2 FMAX\n"
      "CYCL DEF 11.1 SCL 1\nL X+4 FMAX\n");
  expect_same(places(all), {{5, 1, 2}, {5, 5, 2}, {15, -1, 2}, {12, 1, 1}, {14, 1, 1}});
  // Mirrored in one axis, an arc turns the other way.
  EXPECT_EQ(last_of<ArcFeed>(all).turns, -1);
  EXPECT_LT((last_of<ArcFeed>(all).center - Vec3(5, 3, 2)).norm(), kTiny);
}

// --- tilted planes -------------------------------------------------------------------------------

Pose plane_of(const std::string& text) {
  return last_of<TiltedPlaneChange>(run_klartext(text)).program_from_plane.value_or(Pose{});
}
void expect_same(const Pose& a, const Pose& b) {
  EXPECT_LT((a.rotation - b.rotation).norm(), 1e-9) << a.rotation << "\n\n" << b.rotation;
  EXPECT_LT((a.translation - b.translation).norm(), 1e-9);
}

TEST(KlartextPlanes, AreTheirFormsDerivedByHand) {
  // Z of the plane leans to -Y by 30 degrees about X.
  const double c = std::cos(30 * kRadPerDeg);
  Mat3 about_x;
  about_x << 1, 0, 0, 0, c, -0.5, 0, 0.5, c;
  expect_same(plane_of("PLANE SPATIAL SPA+30 SPB+0 SPC+0 STAY\n"), Pose::rotated(about_x));
  expect_same(plane_of("PLANE EULER EULPR+0 EULNU+30 EULROT+0 STAY\n"), Pose::rotated(about_x));
  expect_same(plane_of("PLANE VECTOR BX+5 BY+0 BZ+0 NX+0 NY-1 NZ+1.7320508075688772 STAY\n"),
              Pose::rotated(about_x));
  expect_same(plane_of("Q1 = 30\nPLANE RELATIV SPA+Q1 STAY\n"), Pose::rotated(about_x));
  // X from (1 1 0) along Y, Y towards -X: Z stays.
  Mat3 quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  expect_same(plane_of("PLANE POINTS P1X+1 P1Y+1 P1Z+0 P2X+1 P2Y+9 P2Z+0 P3X-4 P3Y+2 P3Z+0 STAY\n"),
              Pose::rotated(quarter));
  // The base vector counts by what is perpendicular to the normal.
  expect_same(plane_of("PLANE VECTOR BX+0 BY+1 BZ+7 NX+0 NY+0 NZ+2 STAY\n"),
              Pose::rotated(quarter));
}

// One frame in each of its spellings.
TEST(KlartextLaws, FormsOfPlaneThatMeanOneFrameAgree) {
  std::mt19937 dice(11);
  std::uniform_real_distribution<double> any(-170.0, 170.0);
  const auto word = [](const char* name, double value) {
    return fmt::format("{}{:+.12f} ", name, value);
  };
  for (int i = 0; i < 100; ++i) {
    const double pr = any(dice);
    const double nu = any(dice);
    const double rot = any(dice);
    const Pose plane = plane_of("PLANE EULER " + word("EULPR", pr) + word("EULNU", nu) +
                                word("EULROT", rot) + "STAY\n");
    const Mat3& r = plane.rotation;
    std::string vectors = "PLANE VECTOR ";
    std::string points = "PLANE POINTS ";
    const char* const axes[] = {"X", "Y", "Z"};
    for (int k = 0; k < 3; ++k) {
      vectors += word((std::string("B") + axes[k]).c_str(), r(k, 0));
      vectors += word((std::string("N") + axes[k]).c_str(), r(k, 2));
      points += word((std::string("P1") + axes[k]).c_str(), 3.0);
      points += word((std::string("P2") + axes[k]).c_str(), 3.0 + 20 * r(k, 0));
      points += word((std::string("P3") + axes[k]).c_str(), 3.0 + 5 * r(k, 0) + 9 * r(k, 1));
    }
    expect_same(plane_of(vectors + "STAY\n"), plane);
    expect_same(plane_of(points + "STAY\n"), plane);
    // R = Rz Ry Rx.
    const double b = -std::asin(std::clamp(r(2, 0), -1.0, 1.0));
    const double a = std::atan2(r(2, 1), r(2, 2));
    const double z = std::atan2(r(1, 0), r(0, 0));
    expect_same(plane_of("PLANE SPATIAL " + word("SPA", a * kDegPerRad) +
                         word("SPB", b * kDegPerRad) + word("SPC", z * kDegPerRad) + "STAY\n"),
                plane);
    // Turn on turn: Z, then the new X, then the new Z.
    expect_same(plane_of("PLANE RELATIV " + word("SPC", pr) + "STAY\nPLANE RELATIV " +
                         word("SPA", nu) + "STAY\nPLANE RELATIV " + word("SPC", rot) + "STAY\n"),
                plane);
  }
}

TEST(KlartextPlanes, LieAtTheShiftedDatumAndGiveItBack) {
  const auto all = run_klartext(
      "CYCL DEF 7.1 X+10 Y+20 Z+5\nPLANE SPATIAL SPA+0 SPB+90 SPC+0 STAY\n"
      "L X+1 Y+2 Z+3 FMAX\nCYCL DEF 7.1 X+100 Y+0 Z+0\nL X+1 Y+2 Z+3 FMAX\n"
      "CYCL DEF 7.1 X+0\nPLANE RESET STAY\nL X+1 Y+2 Z+3 FMAX\n");
  const auto planes = all_of<TiltedPlaneChange>(all);
  ASSERT_EQ(planes.size(), 2U);
  EXPECT_LT((planes[0].program_from_plane->translation - Vec3(10, 20, 5)).norm(), kTiny);
  EXPECT_FALSE(planes[1].program_from_plane.has_value());
  // In the plane its own shift counts. One that ends there ends the one from before the plane too.
  expect_same(places(all), {{1, 2, 3}, {101, 2, 3}, {1, 2, 3}});
}

TEST(KlartextPlanes, TurnTheAxesWhenTold) {
  EXPECT_EQ(
      all_of<AlignToPlane>(run_klartext("PLANE VECTOR BX+1 BY+0 BZ+0 NX+0 NY-1 NZ+1 TURN FMAX\n"))
          .size(),
      1U);
  EXPECT_TRUE(
      all_of<AlignToPlane>(run_klartext("PLANE EULER EULPR0 EULNU9 EULROT0 STAY\n")).empty());
}

// --- cycles --------------------------------------------------------------------------------------

constexpr const char* kDrill200 =
    "TOOL CALL 1 Z S1000\nM3\nL X+0 Y+0 Z+50 R0 FMAX\n"
    "CYCL DEF 200 DRILLING ~\n  Q200=+2 ;SET-UP CLEARANCE ~\n  Q201=-10 ;DEPTH ~\n"
    "  Q206=+150 ;FEED ~\n  Q202=+6 ;PLUNGING DEPTH ~\n  Q210=+0 ;DWELL ABOVE ~\n"
    "  Q203=+20 ;SURFACE ~\n  Q204=+30 ;2ND CLEARANCE ~\n  Q211=+0.5 ;DWELL\n";

TEST(KlartextCycles, PeckFromTheSurfaceAndGoToTheSecondClearance) {
  const auto all = run_klartext(std::string(kDrill200) + "L X+10 Y+5 FMAX M99\n");
  // Over the hole, to 2 above the surface at 20; to 14, out, 2 above that; to 10, dwell, up.
  expect_same(places(all), {{0, 0, 50},
                            {10, 5, 50},
                            {10, 5, 22},
                            {10, 5, 14},
                            {10, 5, 22},
                            {10, 5, 16},
                            {10, 5, 10},
                            {10, 5, 50}});
  EXPECT_EQ(last_of<Dwell>(all).seconds, 0.5);
  EXPECT_EQ(last_of<LinearFeed>(all).feed.value, 150.0);
}

TEST(KlartextLaws, ACallIsM99AndACycleIsItsMoves) {
  const auto by_m99 = places(run_klartext(std::string(kDrill200) + "L X+10 Y+5 FMAX M99\n"));
  const auto by_call =
      places(run_klartext(std::string(kDrill200) + "L X+10 Y+5 FMAX\nCYCL CALL\n"));
  const auto by_hand = places(
      run_klartext("TOOL CALL 1 Z S1000\nM3\nL X+0 Y+0 Z+50 FMAX\nL X+10 Y+5 FMAX\nL Z+22 FMAX\n"
                   "L Z+14 F150\nL Z+22 FMAX\nL Z+16 FMAX\nL Z+10 F150\nL Z+50 FMAX\n"));
  expect_same(by_call, by_m99);
  expect_same(by_hand, by_m99);
}

TEST(KlartextCycles, ReamAndTap) {
  const auto ream = run_klartext(
      "TOOL CALL 1 Z S500\nL X+1 Y+2 Z+9 FMAX\nCYCL DEF 201 REAMING Q200=2 Q201=-15 Q206=100 "
      "Q211=0.25 Q208=250 Q203=+0 Q204=0\nCYCL CALL M3\n");
  expect_same(places(ream), {{1, 2, 9}, {1, 2, 2}, {1, 2, -15}, {1, 2, 2}});
  const auto feeds = all_of<LinearFeed>(ream);
  ASSERT_EQ(feeds.size(), 2U);
  EXPECT_EQ(feeds[0].feed.value, 100.0);
  EXPECT_EQ(feeds[1].feed.value, 250.0);
  EXPECT_EQ(last_of<Dwell>(ream).seconds, 0.25);
  const auto tap = run_klartext(
      "TOOL CALL 1 Z S500\nM3\nL X+1 Y+2 Z+9 FMAX\nFN 0: Q5 = -8\nCYCL DEF 207 RIGID TAPPING "
      "Q200=+3 Q201=+Q5 Q239=+1.25 Q203=+4 Q204=+20\nCYCL CALL\n");
  expect_same(places(tap), {{1, 2, 9}, {1, 2, 7}, {1, 2, -4}, {1, 2, 7}, {1, 2, 24}});
  EXPECT_EQ(last_of<LinearFeed>(tap).feed.mode, FeedMode::per_revolution);
  EXPECT_EQ(last_of<SpindleChange>(tap).direction, SpindleDirection::clockwise);
}

// --- parameters, tools, the program --------------------------------------------------------------

TEST(KlartextParameters, MeasureLengthsAndAngles) {
  expect_same(
      places(run_klartext("FN 8: Q1 = +3 LEN +4\nFN 13: Q2 = +5 ANG -5\nFN 13: Q3 = -1 ANG +0\n"
                          "L X+Q1 Y+Q2 Z+Q3 FMAX\n")),
      {{5, 135, 270}});
}

TEST(KlartextParameters, StandForToolsSpeedsAndFeeds) {
  const auto all = run_klartext(
      "Q1 = 7\nQ2 = 900\nQ3 = 250\nTOOL CALL Q1 Z SQ2 FQ3\nM3\nL X+1 F AUTO\n"
      "L X+2 FQ2\n");
  EXPECT_EQ(last_of<ToolChange>(all).tool, 7);
  EXPECT_EQ(last_of<SpindleChange>(all).speed, 900.0);
  const auto feeds = all_of<LinearFeed>(all);
  ASSERT_EQ(feeds.size(), 2U);
  EXPECT_EQ(feeds[0].feed.value, 250.0);
  EXPECT_EQ(feeds[1].feed.value, 900.0);
}

TEST(KlartextProgram, TellsWhatItPrints) {
  const auto events = all_of<Event>(run_klartext(
      "0 BEGIN PGM PART MM\n1 FN 15: PRINT Q20\n2 FN 16: F-PRINT TNC:\\MASK.A / SCREEN:\n"
      "3 CYCL DEF 32.0 TOLERANCE\n4 CYCL DEF 32.1 T0.05\n5 END PGM PART MM\n"));
  std::vector<std::string> names;
  for (const Event& event : events) names.push_back(event.name + "|" + event.text);
  EXPECT_EQ(names, (std::vector<std::string>{"BEGIN PGM|PART MM", "FN 15|PRINT Q20",
                                             "FN 16|F-PRINT TNC:\\MASK.A / SCREEN:",
                                             "CYCL DEF 32|TOLERANCE", "CYCL DEF 32|T0.05"}));
}

TEST(KlartextProgram, RaisesErrorsOnlyWhereItRunsIntoThem) {
  const std::string text =
      "FN 9: IF +Q1 EQU +1 GOTO LBL 5\nFN 14: ERROR = 1000\nLBL 5\nL X+3 FMAX\n";
  EXPECT_EQ(places(run_klartext("Q1 = 1\n" + text)).size(), 1U);
  EXPECT_TRUE(complaint("Q1 = 0\n" + text)
                  .starts_with("3:1: error: the program stops with ERROR=1000 (hint: "));
}

// --- what is wrong -------------------------------------------------------------------------------

struct Wrong {
  const char* text;
  const char* complaint;
};

TEST(KlartextErrors, SayWhereWhatAndTheRemedy) {
  const std::vector<Wrong> mistakes{
      {"LP PR+5 PA+0 FMAX\n", "1:4: error: there is no pole"},
      {"CC X+0 Y+0\nLP PA+30 FMAX\n",
       "2:4: error: the polar position goes on from one that is not known: X has not been "
       "programmed yet"},
      {"CC X+0 Y+0\nLP PR+5 PA+0 X+3 FMAX\n", "2:14: error: X3 beside a polar position"},
      {"L X+0 Y+0 FMAX\nCC\nLP PR+5 FMAX\n",
       "3:4: error: a polar position without angle, from the pole"},
      {"L X+5 Y+0 FMAX\nCC X+0 Y+0\nCP IPA+90 DR- F9\n",
       "3:4: error: IPA90 does not turn as DR- says"},
      {"L X+5 Y+0 FMAX\nCC X+0 Y+0\nCP PA+90 F9\n", "3:1: error: CP has no direction"},
      {"L X+5 PR+3 FMAX\n", "1:7: error: PR has no meaning in L"},
      {"L X+5 Y+0 FMAX\nCT X+9 Y+3 F9\n", "2:1: error: the arc leads on from no move"},
      {"L X+0 Y+0 FMAX\nL X+5 FMAX\nCT X+9 Y+0 F9\n",
       "3:1: error: the end of the arc is straight ahead or behind"},
      {"L X+0 Y+0 FMAX\nL X+5 FMAX\nCT X+9 Y+3 FMAX\n", "3:1: error: CT with FMAX"},
      {"L X+0 Y+0 FMAX\nL X+5 FMAX\nCT X+9 Y+3 DR+\n", "3:12: error: DR has no meaning in CT"},
      {"RND R5\n", "1:1: error: RND after no cutting move in the plane"},
      {"CHF 3\n", "1:1: error: CHF after no cutting move in the plane"},
      {"CYCL DEF 7.1 #5\n", "1:14: error: datums of a table are not simulated"},
      {"CYCL DEF 7.1 X+5 F3\n", "1:18: error: F has no meaning in CYCL DEF 7"},
      {"CYCL DEF 7.1\n", "1:1: error: CYCL DEF 7 names no axis"},
      {"CYCL DEF 10.1 ROT+30\nCYCL DEF 7.1 X+5\n", "2:1: error: a datum shift within a rotation"},
      {"CYCL DEF 10.1 30\n", "1:15: error: CYCL DEF 10 has no ROT"},
      {"CYCL DEF 10.1 ROT+30\nL X+5 FMAX\n",
       "2:1: error: a move in a turned frame, but Y has not been programmed yet"},
      {"CYCL DEF 8.1 X\nCYCL DEF 7.1 X+5\n",
       "2:1: error: a datum shift within a rotation, mirror image or scaling"},
      {"CYCL DEF 8.1 X\nCYCL DEF 10.1 ROT+5\n", "2:1: error: a rotation within a mirror image"},
      {"CYCL DEF 8.1 A\n", "1:14: error: CYCL DEF 8 mirrors X, Y and Z"},
      {"CYCL DEF 11.1 0.5\n", "1:15: error: CYCL DEF 11 has no SCL"},
      {"CYCL DEF 11.1 SCL 0\n", "1:15: error: SCL0 is not above zero"},
      {"CYCL DEF 10.1 ROT+5\nPLANE SPATIAL SPA+9 SPB+0 SPC+0 STAY\n",
       "2:1: error: PLANE within a rotation, mirror image or scaling"},
      {"PLANE RELATIV SPA+5 STAY\nCYCL DEF 7.1 X+5\nPLANE RELATIV SPA+5 STAY\n"
       "CYCL DEF 7.1 X+5\nPLANE SPATIAL SPA+9 SPB+0 SPC+0 STAY\n",
       "5:1: error: PLANE on top of a datum shift in the plane before"},
      {"PLANE EULER EULPR+5 EULNU+5 STAY\n", "1:1: error: PLANE EULER needs three angles"},
      {"PLANE RELATIV SPA+5 SPB+5 STAY\n", "1:1: error: PLANE RELATIV needs one angle"},
      {"PLANE VECTOR BX+1 BY+0 BZ+0 NX+2 NY+0 NZ+0 STAY\n",
       "1:1: error: the vectors of PLANE VECTOR span no plane"},
      {"PLANE POINTS P1X+0 P1Y+0 P1Z+0 P2X+1 P2Y+0 P2Z+0 P3X+5 P3Y+0 P3Z+0 STAY\n",
       "1:1: error: the points of PLANE POINTS are on one line"},
      {"PLANE AXIAL B+30 TURN\n", "1:1: error: PLANE AXIAL is not simulated"},
      {"PLANE EULER EULPR EULNU+5 EULROT+5 STAY\n", "1:13: error: EULPR has no number"},
      {"CYCL CALL\n", "1:1: error: CYCL CALL without a cycle"},
      {"L X+0 Y+0 FMAX M99\n", "1:16: error: M99 without a cycle"},
      {"CYCL\n", "1:1: error: CYCL without DEF or CALL"},
      {"CYCL DEF 200 Q200=2 Q201=-5 Q203=0\n", "1:1: error: CYCL DEF 200 has no Q206"},
      {"CYCL DEF 200 Q200=2 Q999=1\n", "1:21: error: Q999 has no meaning in CYCL DEF 200"},
      {"CYCL DEF 200 Q200=2 Q201=-5 Q206=9 Q203=0 Q395=1\n", "1:43: error: Q395 is not simulated"},
      {"CYCL DEF 200 Q200=2 Q201=5 Q206=9 Q203=0\n", "1:21: error: Q201=5 is not below zero"},
      {"CYCL DEF 200 Q200=2 Q201=-5 Q206=0 Q203=0\n",
       "1:29: error: the feed of the cycle is not above zero"},
      {"CYCL DEF 200 Q200=-2 Q201=-5 Q206=9 Q203=0\n", "1:14: error: Q200=-2 is negative"},
      {"CYCL DEF 200 Q200=2 Q201=-5 Q206=9 Q203=0 Q202=0.0001\n",
       "1:43: error: the cycle makes more than 10000 pecks"},
      {"CYCL DEF 200 Q200=2 Q201=-5 Q206=9 Q203=0\nCYCL CALL\n",
       "2:1: error: the place of the hole is not known: X has not been programmed yet"},
      {"CYCL DEF 208 Q200=2\n", "1:1: error: CYCL DEF 208 is not simulated"},
      {"L X+1 M96 FMAX\n", "1:7: error: M96 is not simulated"},
      {"FN 14: ERROR = 1042\n", "1:1: error: the program stops with ERROR=1042"},
      {"FN 14: 3\n", "1:8: error: FN 14 has no ERROR ="},
      {"FN 18: SYSREAD Q1 = ID 20\n", "1:26: error: FN 18 has no NR"},
      {"FN 25: PRESET = X/+0/+5\n", "1:1: error: FN 25 is not simulated"},
      {"FN 8: Q1 = +3 + +4\n", "1:15: error: FN 8 has no LEN"},
      {"FN 13: Q1 = +3 LEN +4\n", "1:16: error: FN 13 has no ANG"},
      {"TOOL CALL QS1 Z\n", "1:11: error: parameter QS1 has no value"},
      {"TOOL CALL Q1 Z\n", "1:11: error: parameter Q1 has no value"},
      {"LN2 X+1\n", "1:1: error: unknown statement LN2 (hint: did you mean LN?)"},
      {"L X+1 FZ0.1\n", "1:7: error: FZ is not simulated"},
  };
  for (const Wrong& wrong : mistakes) {
    const std::string line = complaint(wrong.text);
    EXPECT_TRUE(line.starts_with(wrong.complaint)) << line << "\n" << wrong.text;
    EXPECT_NE(line.find(" (hint: "), std::string::npos) << line;
  }
}

}  // namespace
}  // namespace frustum::parser
