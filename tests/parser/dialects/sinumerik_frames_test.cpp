// TRANS, ROT, SCALE and MIRROR of Sinumerik, against matrices made in another way.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run_in_frame(std::string_view text) {
  return motions(text, {}, Dialect::sinumerik);
}

Eigen::Vector3d end_of(const std::string& text) {
  const AxisTarget end = last_of<Traverse>(run_in_frame(text)).end;
  return {end[X].value_or(1e9), end[Y].value_or(1e9), end[Z].value_or(1e9)};
}

void expect_frame_end(const std::string& text, double x, double y, double z) {
  EXPECT_LT((end_of(text) - Eigen::Vector3d(x, y, z)).norm(), 1e-9)
      << text << end_of(text).transpose();
}

std::string frame_complaint(std::string_view text) {
  const auto lines = complaints(text, {}, Dialect::sinumerik);
  if (lines.empty()) return "none";
  return lines[0].substr(0, lines[0].find(" (hint: "));
}

TEST(SinumerikFrames, TransReplacesAndAtransGoesOn) {
  expect_frame_end("TRANS X10 Y20\nG0 X1 Y2 Z3\n", 11, 22, 3);
  expect_frame_end("TRANS X10 Y20\nTRANS Z5\nG0 X1 Y2 Z3\n", 1, 2, 8);
  expect_frame_end("TRANS X10 Y20\nATRANS X-1 Z5\nG0 X1 Y2 Z3\n", 10, 22, 8);
  expect_frame_end("TRANS X10\nROT\nG0 X1 Y2 Z3\n", 1, 2, 3);
  expect_frame_end("G700 TRANS X1\nG0 X1 Y0 Z0\n", 50.8, 0, 0);
  EXPECT_DOUBLE_EQ(*last_of<Traverse>(run_in_frame("TRANS C10\nG0 C5\n")).end[C],
                   15 * std::numbers::pi / 180);
  // Whether TRANS leaves what ATRANS added, machine data decide.
  const auto assumed = [](std::string_view text) {
    return all_of<Event>(run_in_frame(text)).size();
  };
  EXPECT_EQ(assumed("TRANS X10\nATRANS X5\nTRANS X20\n"), 1U);
  EXPECT_EQ(assumed("TRANS X10\nATRANS X5\nTRANS\nTRANS X20\n"), 0U);
  EXPECT_EQ(assumed("TRANS X10\nAROT Z5\nTRANS X20\n"), 0U);
  // An axis that is not named stays where it is, and the others need not be known.
  EXPECT_DOUBLE_EQ(*last_of<Traverse>(run_in_frame("G0 X4\nTRANS X10\nG0 Y1\n")).end[X], 4.0);
}

TEST(SinumerikFrames, RotTurnsAboutZThenYThenX) {
  expect_frame_end("ROT Z90\nG0 X1 Y0 Z0\n", 0, 1, 0);
  expect_frame_end("ROT RPL=90\nG0 X1 Y0 Z0\n", 0, 1, 0);
  expect_frame_end("G18 ROT RPL=90\nG0 X0 Y0 Z1\n", 1, 0, 0);
  // Z first, then the new Y: a point on Z goes to where the turned X points.
  expect_frame_end("ROT Y90 Z90\nG0 X0 Y0 Z1\n", 0, 1, 0);
  expect_frame_end("ROT X90 Z90\nG0 X0 Y1 Z0\n", 0, 0, 1);
}

TEST(SinumerikFrames, OfFactorsThatAreLeftOutAreOne) {
  expect_frame_end("SCALE X1 Y1\nG0 X1 Y2 Z3\n", 1, 2, 3);
  expect_frame_end("TRANS X4\nR1=1\nASCALE X=R1\nG0 X1 Y2 Z3\n", 5, 2, 3);
}

// X then moves Z of the machine alone, and Z its X, whose place need not be known.
TEST(SinumerikFrames, OfRightAnglesMoveOneAxisByAnother) {
  const auto moves = all_of<Traverse>(run_in_frame("ROT Y-90\nG0 X100 Y2\nZ-7\n"));
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_FALSE(moves[0].end[X].has_value());
  EXPECT_EQ(moves[0].end[Y], 2.0);
  EXPECT_EQ(moves[0].end[Z], 100.0);
  EXPECT_EQ(moves[1].end[X], 7.0);
  EXPECT_EQ(moves[1].end[Z], 100.0);
}

TEST(SinumerikFrames, OrderMatters) {
  expect_frame_end("TRANS X10\nAROT Z90\nG0 X1 Y0 Z0\n", 10, 1, 0);
  expect_frame_end("ROT Z90\nATRANS X10\nG0 X1 Y0 Z0\n", 0, 11, 0);
  expect_frame_end("SCALE X2 Y2 Z2\nATRANS X10\nG0 X1 Y2 Z3\n", 22, 4, 6);
  expect_frame_end("TRANS X10\nASCALE X2 Y2 Z2\nG0 X1 Y2 Z3\n", 12, 4, 6);
}

TEST(SinumerikFrames, MirrorsTurnArcsRound) {
  expect_frame_end("MIRROR X0\nG0 X1 Y2 Z3\n", -1, 2, 3);
  expect_frame_end("TRANS X10\nAMIRROR X0\nG0 X1 Y2 Z3\n", 9, 2, 3);
  expect_frame_end("MIRROR Z0\nG0 X1 Y2 Z3\n", 1, 2, -3);
  const std::string arc = "G0 X0 Y0 Z0\nG2 X10 Y0 I5 J0 F100\n";
  EXPECT_EQ(last_of<ArcFeed>(run_in_frame(arc)).turns, -1);
  const ArcFeed mirrored = last_of<ArcFeed>(run_in_frame("MIRROR X0\n" + arc));
  EXPECT_EQ(mirrored.turns, 1);
  EXPECT_NEAR(mirrored.center[0], -5.0, 1e-12);
  EXPECT_EQ(last_of<ArcFeed>(run_in_frame("MIRROR X0 Y0\n" + arc)).turns, -1);
  // A mirror of the height leaves the arc as it is.
  EXPECT_EQ(last_of<ArcFeed>(run_in_frame("MIRROR Z0\n" + arc)).turns, -1);
  // Mirrored and turned in its plane.
  const ArcFeed turned = last_of<ArcFeed>(run_in_frame("ROT Z90\nAMIRROR X0\n" + arc));
  EXPECT_EQ(turned.turns, 1);
  EXPECT_NEAR(turned.center[1], -5.0, 1e-9);
}

TEST(SinumerikFrames, MachineCoordinatesKnowNone) {
  for (const char* word : {"SUPA", "G53", "G153"}) {
    expect_frame_end(fmt::format("TRANS X10 Y10 Z10\nG0 {} D0 X1 Y2 Z3\n", word), 1, 2, 3);
    EXPECT_EQ(last_of<Traverse>(run_in_frame(fmt::format("G0 {} D0 X1\n", word))).coordinates,
              Coordinates::machine);
  }
}

TEST(SinumerikFrames, LieInTheSwivelledPlaneAndEndWithANewOne) {
  const std::string swivel = "CYCLE800(0,\"T\",0,57,0,0,0,30,0,0)\n";
  expect_frame_end(swivel + "TRANS X10\nG0 X1 Y2 Z3\n", 11, 2, 3);
  expect_frame_end("TRANS X10\n" + swivel + "G0 X1 Y2 Z3\n", 1, 2, 3);
  expect_frame_end("ROT Z30\nCYCLE800()\nG0 X1 Y2 Z3\n", 1, 2, 3);
}

TEST(SinumerikFrames, SwivelsGoOnWithinTheLast) {
  const auto plane_of = [](const std::string& text) {
    return *last_of<TiltedPlaneChange>(run_in_frame(text)).program_from_plane;
  };
  const Pose both = plane_of(
      "CYCLE800(0,\"T\",0,57,1,2,3,30,0,0)\nTRANS X10\nAROT Z90\n"
      "CYCLE800(0,\"T\",1,57,0,5,0,0,20,0)\n");
  const Pose first = plane_of("CYCLE800(0,\"T\",0,57,1,2,3,30,0,0)\n");
  // 5 along the turned Y is -5 along X, from X10.
  EXPECT_LT((both.translation - first.point(Vec3(5, 0, 0))).norm(), 1e-9);
  const double angle = 20 * std::numbers::pi / 180;
  const Vec3 normal(0, std::sin(angle), std::cos(angle));
  EXPECT_LT((both.direction(Vec3::UnitZ()) - first.direction(normal)).norm(), 1e-9);
}

TEST(SinumerikFrames, SwivelsBySolidAngles) {
  const auto plane =
      last_of<TiltedPlaneChange>(run_in_frame("CYCLE800(0,\"T\",0,64,0,0,0,90,30,0)\n"));
  // Z turned towards X about Y, then X towards Y about Z.
  const double angle = 30 * std::numbers::pi / 180;
  const Vec3 normal(0, std::sin(angle), std::cos(angle));
  EXPECT_LT((plane.program_from_plane->direction(Vec3::UnitZ()) - normal).norm(), 1e-12);
}

RC_GTEST_PROP(SinumerikFramesLaws, StatementsComposeAsMatrices, ()) {
  const int count = *rc::gen::inRange(1, 6);
  const auto number = [](int from, int to) {
    return static_cast<double>(*rc::gen::inRange(from * 10, to * 10)) / 10.0;
  };
  Eigen::Affine3d frame = Eigen::Affine3d::Identity();
  std::string text = "G0 X0 Y0 Z0\n";
  for (int i = 0; i < count; ++i) {
    const bool within = *rc::gen::arbitrary<bool>();
    if (!within) frame.setIdentity();
    const int kind = *rc::gen::inRange(0, 4);
    const std::string more = within ? "A" : "";
    const double x = number(-90, 90);
    const double y = number(-90, 90);
    const double z = number(-90, 90);
    constexpr double kDegree = std::numbers::pi / 180.0;
    if (kind == 0) {
      text += fmt::format("{}TRANS X{} Y{} Z{}\n", more, x, y, z);
      frame.translate(Eigen::Vector3d(x, y, z));
    } else if (kind == 1) {
      text += fmt::format("{}ROT X{} Y{} Z{}\n", more, x, y, z);
      frame.rotate(Eigen::AngleAxisd(z * kDegree, Eigen::Vector3d::UnitZ()));
      frame.rotate(Eigen::AngleAxisd(y * kDegree, Eigen::Vector3d::UnitY()));
      frame.rotate(Eigen::AngleAxisd(x * kDegree, Eigen::Vector3d::UnitX()));
    } else if (kind == 2) {
      const double factor = number(1, 4);
      text += fmt::format("{0}SCALE X{1} Y{1} Z{1}\n", more, factor);
      frame.scale(factor);
    } else {
      text += fmt::format("{}MIRROR{}{} Z0\n", more, x > 0 ? " X0" : "", y > 0 ? " Y0" : "");
      frame.scale(Eigen::Vector3d(x > 0 ? -1 : 1, y > 0 ? -1 : 1, -1));
    }
  }
  const Eigen::Vector3d words(number(-9, 9), number(-9, 9), number(-9, 9));
  text += fmt::format("G0 X{} Y{} Z{}\n", words[0], words[1], words[2]);
  const Eigen::Vector3d place = frame * words;
  RC_ASSERT((end_of(text) - place).norm() < 1e-9 * (1.0 + place.norm()));
}

TEST(SinumerikFrames, TellsMistakes) {
  struct Mistake {
    const char* text;
    const char* complaint;
  };
  const Mistake mistakes[] = {
      {"ATRANS\n", "1:1: error: ATRANS names no axis"},
      {"ROT X5 RPL=3\n", "1:5: error: X5 beside RPL"},
      {"SCALE X2 Y2\n", "1:1: error: SCALE scales the axes in different ways"},
      {"SCALE X2 Y2 Z3\n", "1:13: error: SCALE scales the axes in different ways"},
      {"ASCALE X0 Y0 Z0\n", "1:8: error: X0 is no factor"},
      {"TRANS I5\n", "1:7: error: I5 has no meaning in this block"},
      {"TRANS X5 ROT Z5\n", "1:10: error: TRANS and ROT contradict each other in a block"},
      {"ROTS X5 Y5\n", "1:1: error: ROTS is not simulated"},
      {"G0 X0\nROT Z30\nG0 X5\n",
       "3:1: error: a move in a turned frame, but Y has not been programmed yet"},
      {"G0 X0\nTRANS X5\nG91 X1\n",
       "3:5: error: X1 is incremental, but the frame has changed since X was programmed"},
      {"MIRROR\nAMIRROR\n", "2:1: error: AMIRROR names no axis"},
  };
  for (const Mistake& mistake : mistakes) {
    EXPECT_EQ(frame_complaint(mistake.text), mistake.complaint) << mistake.text;
  }
}

}  // namespace
}  // namespace frustum::parser
