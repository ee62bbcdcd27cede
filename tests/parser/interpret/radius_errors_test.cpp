// What radius compensation and splines refuse: message, line and column of each.
#include <gtest/gtest.h>

#include <span>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

struct RadiusMistake {
  Dialect dialect;
  std::string_view text;
  std::string_view complaint;
};

InterpreterOptions with_radius_tools() {
  InterpreterOptions options;
  options.tools[1].diameter = 12.0;
  options.tools[2].diameter = 8.0;
  options.tools[5].diameter = 0.0;
  for (const AxisLetter axis : kAxisLetters) options.start[axis] = 0.0;
  return options;
}

void expect(std::span<const RadiusMistake> mistakes) {
  for (const RadiusMistake& mistake : mistakes) {
    const auto lines = complaints(mistake.text, with_radius_tools(), mistake.dialect);
    ASSERT_EQ(lines.size(), 1U) << mistake.text;
    const std::size_t hint = lines[0].find(" (hint: ");
    EXPECT_NE(hint, std::string::npos) << lines[0];
    EXPECT_EQ(lines[0].substr(0, hint), mistake.complaint) << mistake.text;
  }
}

using enum Dialect;

TEST(RadiusErrors, OfAnotherNumberOnTheWay) {
  constexpr RadiusMistake kMistakes[] = {
      {fanuc, "G42 D1 F100\nG1 X20\nX40\nD1\nX50\nD2\nX60\nM30\n",
       "6:1: error: D2 with radius compensation on"},
      {fanuc, "G42 D1 F100\nG1 X20\nX40\nD0 X50\nX60\nM30\n",
       "4:1: error: D0 with radius compensation on"},
  };
  expect(kMistakes);
}

TEST(RadiusErrors, OfTheContour) {
  constexpr RadiusMistake kMistakes[] = {
      {linuxcnc, "G41 D1 F100\nG1 X20\nX20 Y3\nX0\nM2\n",
       "3:1: error: the tool, of radius 6 mm, does not fit into the corner: the move after it is "
       "3 mm too short"},
      {linuxcnc, "G41 D1 F100\nG1 X20\nX20 Y20\nX15\nY40\nM2\n",
       "4:1: error: the tool, of radius 6 mm, does not fit into the corner: the move after it is "
       "1 mm too short"},
      {linuxcnc, "G41 D1 F100\nG1 X20\nY10\nX0\nM2\n",
       "4:1: error: the tool, of radius 6 mm, does not fit into the corner: the move before it is "
       "2 mm too short"},
      {linuxcnc, "G41 D1 F100\nG1 X20\nY30\nX17\nM2\n",
       "4:1: error: the tool, of radius 6 mm, does not fit into the corner: the move after it is "
       "3 mm too short"},
      {linuxcnc, "G41 D1 F100\nG1 X20\nG3 X20 Y8 J4\nM2\n",
       "3:1: error: the tool, of radius 6 mm, is inside an arc of radius 4 mm"},
      {linuxcnc, "G42 D1 F100\nG1 X20\nG2 X20 Y-12 J-6\nM2\n",
       "3:1: error: the tool, of radius 6 mm, is inside an arc of radius 6 mm"},
      {linuxcnc, "G41 D1 F100\nG1 X20\nG3 X34 Y0 I7\nG1 X0\nM2\n",
       "4:1: error: the tool, of radius 6 mm, does not fit into the corner: the paths beside its "
       "two "
       "moves miss each other by 5 mm"},
      {linuxcnc, "G41 D1 F100\nG1 X6\nM2\n",
       "2:1: error: the entry move goes 6 mm, which is not more than the tool's radius of 6 mm"},
      {linuxcnc, "G41 D1 F100\nG1 Z-5\nM2\n",
       "2:1: error: the first move with radius compensation does not go along the plane"},
      {linuxcnc, "G41 D1 F100\nG3 X4 Y4 J4\nM2\n",
       "2:1: error: the entry move goes 5.65685 mm, which is not more than the tool's radius of 6 "
       "mm"},
      {linuxcnc, "G41 D1 F100\nG1 X20\nG40\nG2 X30 Y10 J10\nM2\n",
       "4:1: error: the first move after radius compensation is an arc"},
      {fanuc, "G41 D1\nG3 X40 Y40 J40 F100\nG40 G1 X80\nM30\n",
       "2:1: error: the first move with radius compensation is an arc"},
      {fanuc, "G42 D1\nG1 X4 F100\nG40 G1 X80\nM30\n",
       "2:1: error: the entry move goes 4 mm, which is not more than the tool's radius of 6 mm"},
      {heidenhain, "TOOL CALL 1 Z S100\nL X+5 Y+0 RL F100\nL Y+50\n",
       "2:1: error: the entry move goes 5 mm, which is not more than the tool's radius of 6 mm"},
  };
  expect(kMistakes);
}

TEST(RadiusErrors, OfTheToolAndItsWord) {
  constexpr RadiusMistake kMistakes[] = {
      {linuxcnc, "G41 D9\n", "1:5: error: nothing gives the diameter of tool 9"},
      {linuxcnc, "G41 D1.5\n", "1:5: error: D1.5 is not a whole number"},
      {linuxcnc, "G41.1\n", "1:1: error: G41.1 without D"},
      {linuxcnc, "G41.1 D4 L3\n", "1:10: error: G41.1 with a lathe tool outside G18"},
      {linuxcnc, "G19 G41 D1\n", "1:5: error: G41 in G19"},
      {linuxcnc, "G41 D1\nG42 D1\n",
       "2:1: error: G42 while radius compensation is on, since line 1"},
      {linuxcnc, "G41 D1\nG41 D1\n",
       "2:1: error: G41 while radius compensation is on, since line 1"},
      {fanuc, "G41\n", "1:1: error: G41 without D"},
      {fanuc, "G41 D7\n", "1:5: error: nothing gives the diameter of tool 7"},
      {fanuc, "G41 D1\nG42 D1\n", "2:1: error: G42 while radius compensation is on, since line 1"},
      {fanuc, "G41 D1\nG41 D2\n", "2:1: error: G41 while radius compensation is on, since line 1"},
      {fanuc, "G41.2 D1\n", "1:1: error: G41.2 is not simulated"},
      {sinumerik, "G41\n", "1:1: error: G41 without a tool in the spindle"},
      {sinumerik, "T9 D1 M6\nG42\n", "2:1: error: nothing gives the diameter of tool 9"},
      {sinumerik, "G451\n", "1:1: error: G451 is not simulated"},
      {sinumerik, "KONT\n", "1:1: error: KONT is not simulated"},
      {heidenhain, "TOOL CALL 9 Z S100\nL X+50 RR F100\n",
       "2:8: error: nothing gives the diameter of tool 9"},
      {heidenhain, "TOOL CALL 1 Z S100\nL X+50 RL F100\nL X+90 RR\n",
       "3:8: error: RR while radius compensation is on, since line 2"},
      {heidenhain, "LN X+50 NX+0 NY+0 NZ+1 RL F100\n", "1:24: error: RL in LN is not simulated"},
  };
  expect(kMistakes);
}

TEST(RadiusErrors, OfWhatMayNotHappenWhileItIsOn) {
  constexpr RadiusMistake kMistakes[] = {
      {linuxcnc, "G41 D1\nG18\n", "2:1: error: G18 with radius compensation on"},
      {linuxcnc, "G41 D1\nG28\n", "2:1: error: G28 with radius compensation on"},
      {linuxcnc, "G41 D1\nG53 G0 X0\n", "2:1: error: G53 with radius compensation on"},
      {linuxcnc, "G41 D1\nG55\n", "2:1: error: G55 with radius compensation on"},
      {linuxcnc, "G41 D1\nG92 X0\n", "2:1: error: G92 with radius compensation on"},
      {linuxcnc, "G41 D1\nG52 X1\n", "2:1: error: G52 with radius compensation on"},
      {linuxcnc, "G41 D1\nG43 H1\n", "2:1: error: G43 with radius compensation on"},
      {linuxcnc, "G41 D1\nG49\n", "2:1: error: G49 with radius compensation on"},
      {linuxcnc, "G41 D1\nT2 M6\n", "2:4: error: M6 with radius compensation on"},
      {linuxcnc, "G41 D1\nG81 X1 Z-1 R1 F100\n",
       "2:1: error: a canned cycle with radius compensation on"},
      {linuxcnc, "G41 D1\nG5.1 X10 I1 J1 F100\n",
       "2:1: error: a spline with radius compensation on"},
      {linuxcnc, "G41 D1\nG1 X20 A5 F100\n", "2:8: error: A5 with radius compensation on"},
      {linuxcnc, "M428\nG41 D1\n", "2:1: error: radius compensation with tool-tip control"},
      {fanuc, "G41 D1\nG68 X0 Y0 R30\n", "2:1: error: G68 with radius compensation on"},
      {fanuc, "G41 D1\nG68.2 X0 Y0 Z0 I0 J0 K0\n", "2:1: error: G68.2 with radius compensation on"},
      {fanuc, "G43.4 H1\nG41 D1\n", "2:1: error: radius compensation with tool-tip control"},
      {fanuc, "G41 D1\nG0 X50\nY50\nM30\n",
       "4:1: error: radius compensation, on since line 1, is still on at the end of the program"},
      {fanuc, "G0 X0\nG42 D1\nG0 X50\nY50\n",
       "2:1: error: radius compensation, on since line 2, is still on at the end of the program"},
      {sinumerik, "T1 D1 M6\nG41\nTRAORI\n", "3:1: error: TRAORI with radius compensation on"},
      {sinumerik, "T1 D1 M6\nG41\nG1 X50 D0 F100\n", "3:8: error: D0 with radius compensation on"},
      {heidenhain, "TOOL CALL 1 Z S100\nL X+50 RL F100\nL C+90\n",
       "3:3: error: C90 with radius compensation on"},
      {heidenhain, "TOOL CALL 1 Z S100\nL X+50 RL F100\nL Y+50\nL Z+50 FMAX M91\n",
       "4:13: error: M91 with radius compensation on"},
      {heidenhain, "TOOL CALL 1 Z S100\nL X+50 RL F100\nTOOL CALL 2 Z\n",
       "3:1: error: TOOL CALL with radius compensation on"},
  };
  expect(kMistakes);
}

TEST(RadiusErrors, TooMuchBetweenTwoMovesOfTheContour) {
  std::string text = "G41 D1 F100\nG1 X20\n";
  for (int i = 0; i < 10'001; ++i) text += i % 2 == 0 ? "Z1\n" : "Z2\n";
  const auto lines = complaints(text, with_radius_tools(), linuxcnc);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].starts_with("10002:1: error: 10000 motions and events without a move"))
      << lines[0];
}

TEST(SplineErrors, OfTheirWords) {
  constexpr RadiusMistake kMistakes[] = {
      {linuxcnc, "F100\nG18 G5 X10 Y5 I1 J1 P1 Q1\n", "2:12: error: Y5 in a spline"},
      {linuxcnc, "F100\nG5 X10 Z5 I1 J1 P1 Q1\n", "2:8: error: Z5 in a spline"},
      {linuxcnc, "F100\nG5.1 X10 C5 I1 J1\n", "2:10: error: C5 in a spline"},
      {linuxcnc, "F100\nG5 X10 I1 J1 P1\n", "2:14: error: G5 without P and Q"},
      {linuxcnc, "F100\nG5 X10 I1 J1\n", "2:1: error: G5 without P and Q"},
      {linuxcnc, "F100\nG5 X10 J1 P1 Q1\n", "2:8: error: G5 without I and J"},
      {linuxcnc, "F100\nG5 X10 P1 Q1\n", "2:1: error: G5 without I and J"},
      {linuxcnc, "F100\nG5 X10 I1 J1 P1 Q1\nG1 X20\nG5 X30 P1 Q1\n",
       "4:1: error: G5 without I and J"},
      {linuxcnc, "F100\nG5.1 X10\n", "2:1: error: G5.1 without I and J"},
      {linuxcnc, "F100\nG5.1 X10 I3\n", "2:10: error: G5.1 without I and J"},
      {linuxcnc, "G5.1 X10 I3 J3\n", "1:1: error: G5.1 without a feed rate"},
      {linuxcnc, "F100\nG5.3\n", "2:1: error: G5.3 without G5.2"},
      {linuxcnc, "F100\nG5.2 P1\nX10 Y0 P1\nG5.3\n",
       "4:1: error: 2 control points for a spline of order 3"},
      {linuxcnc, "F100\nG5.2 P1\nX10 Y0\n", "3:1: error: a control point without a weight"},
      {linuxcnc, "F100\nG5.2 P1\nX10 P1\n", "3:1: error: a control point without X and Y"},
      {linuxcnc, "F100\nG5.2 P0\n", "2:6: error: the weight P0 is out of range"},
      {linuxcnc, "F100\nG5.2 P1 L2\n", "2:9: error: L2 is out of range"},
      {linuxcnc, "F100\nG5.2 P1\nG1 X5\n",
       "3:1: error: a move between the points of the spline that G5.2 began on line 2"},
      {linuxcnc, "F100\nG5.2 P1\nG92 X5\n",
       "3:1: error: a move between the points of the spline that G5.2 began on line 2"},
      {linuxcnc, "F100\nG5.2 P1\nX1 Y1 P1\nX2 Y1 P1\nM2\n",
       "2:1: error: the spline that G5.2 begins has no G5.3"},
      {linuxcnc, "F100\nG5.2 P1\nX1 Y1 P1\n",
       "2:1: error: the spline that G5.2 begins has no G5.3"},
      {linuxcnc, "F100\nG41 D1 G1 X20\nG40\nG5.1 X40 I3 J3\n",
       "4:1: error: the first move after radius compensation is a spline"},
  };
  expect(kMistakes);
}

}  // namespace
}  // namespace frustum::parser
