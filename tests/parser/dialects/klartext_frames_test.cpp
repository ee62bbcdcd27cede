// PLANE PROJECTED and MOVE, CYCL DEF 19 and 26 of Klartext, with frames derived by hand.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

constexpr double kTinyFrame = 1e-12;

std::vector<Motion> run_frames(const std::string& text) {
  return motions(text, {}, Dialect::heidenhain);
}
Mat3 rotation_of(const std::string& text) {
  return last_of<TiltedPlaneChange>(run_frames(text)).program_from_plane.value_or(Pose{}).rotation;
}
Vec3 last_place(const std::string& text) {
  const AxisTarget end = last_of<Traverse>(run_frames(text)).end;
  return {end[X].value_or(-999.0), end[Y].value_or(-999.0), end[Z].value_or(-999.0)};
}

TEST(KlartextFrames, AProjectedPlaneHoldsItsLinesAboveXAndY) {
  EXPECT_LT((rotation_of("PLANE PROJECTED PROPR+0 PROMIN+45 ROT+0 STAY\n") -
             rotation_of("PLANE SPATIAL SPA+45 SPB+0 SPC+0 STAY\n"))
                .norm(),
            kTinyFrame);
  EXPECT_LT((rotation_of("PLANE PROJECTED PROPR+30 PROMIN+0 ROT+0 STAY\n") -
             rotation_of("PLANE SPATIAL SPA+0 SPB+30 SPC+0 STAY\n"))
                .norm(),
            kTinyFrame);
  // X leans by 24 degrees within Z/X, the line above Y by 35 within Y/Z; then X is turned in the
  // plane.
  const double p = 24 * kRadPerDeg;
  const double m = 35 * kRadPerDeg;
  const Mat3 leaning = rotation_of("PLANE PROJECTED PROPR+24 PROMIN+35 ROT+0 STAY\n");
  const Vec3 above_y(0, std::cos(m), std::sin(m));
  EXPECT_LT((leaning.col(0) - Vec3(std::cos(p), 0, -std::sin(p))).norm(), kTinyFrame);
  EXPECT_NEAR(leaning.col(2).dot(above_y), 0.0, kTinyFrame);
  EXPECT_GT(leaning.col(2)[2], 0.0);
  const Mat3 turned = rotation_of("PLANE PROJECTED PROPR+24 PROMIN+35 ROT+30 STAY\n");
  const double t = 30 * kRadPerDeg;
  EXPECT_LT((turned.col(0) - (std::cos(t) * leaning.col(0) + std::sin(t) * leaning.col(1))).norm(),
            kTinyFrame);
  EXPECT_LT((turned.col(2) - leaning.col(2)).norm(), kTinyFrame);
}

// The tip is held: tool-tip control is on for the turn alone.
TEST(KlartextFrames, MoveTurnsTheAxesWithTheTipHeld) {
  const std::string tool = "TOOL CALL 1 Z S1000\nL X+0 Y+0 Z+5 FMAX\n";
  const auto names = [](const std::vector<Motion>& all) {
    std::string found;
    for (const Motion& motion : all) {
      if (const auto* change = std::get_if<CompensationChange>(&motion.command)) {
        found += change->mode == LengthCompensation::tool_centre_point ? "tip " : "length ";
      } else if (const auto* plane = std::get_if<TiltedPlaneChange>(&motion.command)) {
        found += plane->program_from_plane ? "plane " : "no-plane ";
      } else if (std::holds_alternative<AlignToPlane>(motion.command)) {
        found += "align ";
      } else if (std::holds_alternative<Traverse>(motion.command)) {
        found += "rapid ";
      }
    }
    return found;
  };
  const std::string plane = "PLANE SPATIAL SPA+0 SPB+30 SPC+0 ";
  EXPECT_EQ(names(run_frames(tool + plane + "MOVE DIST0 FMAX\n")),
            "length rapid plane tip align length ");
  EXPECT_EQ(names(run_frames(tool + plane + "MOVE\nPLANE RESET MOVE\n")),
            "length rapid plane tip align length plane tip align length no-plane ");
  EXPECT_EQ(names(run_frames(tool + plane + "TURN MB MAX FMAX\n")), "length rapid plane align ");
  EXPECT_EQ(names(run_frames(tool + plane + "STAY\nPLANE RESET STAY\n")),
            "length rapid plane no-plane ");
  // Under M128 the tip is held already, and goes on to be.
  EXPECT_EQ(names(run_frames(tool + "M128\n" + plane + "MOVE\n")), "length rapid tip plane align ");
}

TEST(KlartextFrames, Cycle19GivesSpatialAngles) {
  const std::string cycle = "CYCL DEF 19.0 WORKING PLANE\nCYCL DEF 19.1 A+10 B+45 C-30";
  EXPECT_LT(
      (rotation_of(cycle + "\n") - rotation_of("PLANE SPATIAL SPA+10 SPB+45 SPC-30 STAY\n")).norm(),
      kTinyFrame);
  EXPECT_TRUE(all_of<AlignToPlane>(run_frames(cycle + "\n")).empty());
  // A feed turns the axes.
  EXPECT_EQ(all_of<AlignToPlane>(run_frames(cycle + " F2000 SETUP50\n")).size(), 1U);
  const auto ended = all_of<TiltedPlaneChange>(run_frames(
      cycle + "\nCYCL DEF 19.1 A+0 B+0 C+0\nCYCL DEF 19.0 WORKING PLANE\nCYCL DEF 19.1\n"));
  ASSERT_EQ(ended.size(), 3U);
  EXPECT_FALSE(ended.back().program_from_plane);
}

TEST(KlartextFrames, Cycle26ScalesByOneFactorAboutItsCentre) {
  const std::string scaled = "CYCL DEF 26.0 SCALING FACTOR AXIS-SPEC\nCYCL DEF 26.1 ";
  EXPECT_LT((last_place(scaled + "X2 Y2 Z2\nL X+1 Y+2 Z+3 FMAX\n") - Vec3(2, 4, 6)).norm(),
            kTinyFrame);
  EXPECT_LT(
      (last_place(scaled + "X2 Y2 Z2 CCX+10 CCY+20\nL X+11 Y+22 Z+3 FMAX\n") - Vec3(12, 24, 6))
          .norm(),
      kTinyFrame);
  EXPECT_LT(
      (last_place("Q1 = 0.5\n" + scaled + "X+Q1 Y+Q1 Z+Q1\nL X+1 Y+2 Z+4 FMAX\n") - Vec3(0.5, 1, 2))
          .norm(),
      kTinyFrame);
  EXPECT_LT((last_place(scaled + "X2 Y2 Z2\n" + scaled + "X1 Y1 Z1\nL X+1 Y+2 Z+3 FMAX\n") -
             Vec3(1, 2, 3))
                .norm(),
            kTinyFrame);
  // An axis that is not named keeps its factor, which is 1 at first.
  EXPECT_LT((last_place(scaled + "X1 Y1\nL X+1 Y+2 Z+3 FMAX\n") - Vec3(1, 2, 3)).norm(),
            kTinyFrame);
}

struct WrongFrame {
  const char* text;
  const char* complaint;
};

TEST(KlartextFrameErrors, SayWhereWhatAndTheRemedy) {
  const WrongFrame mistakes[] = {
      {"PLANE PROJECTED PROPR+0 PROMIN+10 STAY\n",
       "1:1: error: PLANE PROJECTED needs three angles"},
      {"PLANE PROJECTED PROPR+90 PROMIN+10 ROT+0 STAY\n", "1:17: error: PROPR90 is out of range"},
      {"PLANE PROJECTED PROPR+0 PROMIN-95 ROT+0 STAY\n", "1:25: error: PROMIN-95 is out of range"},
      {"PLANE AXIAL B+30 C+0 TURN\n", "1:1: error: PLANE AXIAL is not simulated"},
      {"PLANE SPATIAL SPA+0 SPB+0 SPC+0 TURN STAY\n", "1:38: error: STAY beside TURN"},
      {"PLANE SPATIAL SPA+0 SPB+0 SPC+0 MOVE\n",
       "1:33: error: MOVE holds the tip of a tool, but no tool is called"},
      {"TOOL CALL 1 Z\nPLANE SPATIAL SPA+0 SPB+0 SPC+0 MOVE DIST50 F1000\n",
       "2:38: error: DIST 50 with MOVE is not simulated"},
      {"CYCL DEF 19.1 B+45 C+0\n", "1:1: error: CYCL DEF 19 has no A"},
      {"CYCL DEF 19.1 A+45 B+0 C+0 X+5\n", "1:28: error: X has no meaning in CYCL DEF 19"},
      {"CYCL DEF 19.1 A+45 A+0 B+0 C+0\n", "1:20: error: A is given twice in a block"},
      {"CYCL DEF 26.1\n", "1:1: error: CYCL DEF 26 has no factor"},
      {"CYCL DEF 26.1 X2 Y2 Z3\n", "1:21: error: Z3 scales one axis other than the rest"},
      {"CYCL DEF 26.1 X2 Y2\n", "1:15: error: X2 scales one axis other than the rest"},
      {"CYCL DEF 26.1 X2 Y2 Z2\nCYCL DEF 26.1 X1 Y1\n",
       "2:15: error: X1 scales one axis other than the rest"},
      {"CYCL DEF 26.1 X0 Y0 Z0\n", "1:15: error: X0 is not above zero"},
      {"CYCL DEF 26.1 X2 SCL2\n", "1:18: error: SCL has no meaning in CYCL DEF 26"},
      {"CYCL DEF 10.1 ROT+10\nCYCL DEF 26.1 X2 Y2 Z2\n",
       "2:1: error: CYCL DEF 26 within a turned frame"},
  };
  for (const WrongFrame& wrong : mistakes) {
    const auto lines = complaints(wrong.text, {}, Dialect::heidenhain);
    ASSERT_EQ(lines.size(), 1U) << wrong.text;
    EXPECT_EQ(lines[0].substr(0, lines[0].find(" (hint: ")), wrong.complaint);
    EXPECT_NE(lines[0].find(" (hint: "), std::string::npos) << lines[0];
  }
}

}  // namespace
}  // namespace frustum::parser
