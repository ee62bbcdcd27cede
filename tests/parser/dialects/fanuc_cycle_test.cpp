// The bores of Fanuc that shift the tool.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "core/decimal.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

// "rapid 1 2 3; feed 1 2 -3; off; ..."
std::string steps(std::string_view text) {
  std::string found;
  const auto place = [](const char* how, const AxisTarget& end) {
    const auto number = [&](AxisLetter axis) { return shortest_decimal(end[axis].value_or(0.0)); };
    return std::string(how) + " " + number(X) + " " + number(Y) + " " + number(Z) + "; ";
  };
  for (const Motion& motion : motions(text)) {
    if (const auto* move = std::get_if<Traverse>(&motion.command))
      found += place("rapid", move->end);
    if (const auto* move = std::get_if<LinearFeed>(&motion.command))
      found += place("feed", move->end);
    if (const auto* spindle = std::get_if<SpindleChange>(&motion.command)) {
      found += spindle->direction == SpindleDirection::off ? "off; " : "on; ";
    }
    if (const auto* pause = std::get_if<Dwell>(&motion.command)) {
      found += "dwell " + shortest_decimal(pause->seconds) + "; ";
    }
    if (const auto* event = std::get_if<Event>(&motion.command)) found += event->name + "; ";
  }
  return found;
}

TEST(FanucCycle, FineBoreLeavesTheWallByQ) {
  EXPECT_EQ(steps("S500 M3\nG0 X0 Y0 Z9\nG99 G76 X5 Y6 R2 Z-8 Q0.5 P1000 F50\nG80\n"),
            "on; rapid 0 0 9; rapid 5 6 9; rapid 5 6 2; feed 5 6 -8; dwell 1; off; orient_spindle; "
            "rapid 5.5 6 -8; rapid 5.5 6 2; rapid 5 6 2; on; ");
  // In G18 the shift is along Z.
  EXPECT_NE(steps("S500 M3\nG18 G0 X0 Y9 Z0\nG99 G76 X5 Z6 R2 Y-8 Q0.5 F50\nG80\n")
                .find("rapid 5 -8 6.5; rapid 5 2 6.5; rapid 5 2 6; "),
            std::string::npos);
}

TEST(FanucCycle, BackBoreEntersBesideTheHoleAndCutsUp) {
  EXPECT_EQ(steps("S500 M3\nG0 X0 Y0 Z9\nG98 G87 X5 Y6 R-20 Z-12 Q2 F50\nG80\n"),
            "on; rapid 0 0 9; rapid 5 6 9; off; orient_spindle; rapid 7 6 9; rapid 7 6 -20; "
            "rapid 5 6 -20; on; feed 5 6 -12; dwell 0; off; orient_spindle; rapid 7 6 -12; "
            "rapid 7 6 9; rapid 5 6 9; on; ");
}

// Z is where feeding begins, I the bottom; in G91 Z counts from where the tool was, I from there.
TEST(FanucCycle, DrillOfFagorHasItsDepthInI) {
  EXPECT_EQ(steps("G0 X0 Y0 Z9\nG99 G81 X5 Y6 Z2 I-8 F50\nX7\nG80\n"),
            "rapid 0 0 9; cycle with I; rapid 5 6 9; rapid 5 6 2; feed 5 6 -8; rapid 5 6 2; "
            "rapid 7 6 2; feed 7 6 -8; rapid 7 6 2; ");
  EXPECT_EQ(steps("G0 X0 Y0 Z9\nG98 G91 G81 X5 Z-7 I-3 F50\nG80\n"),
            "rapid 0 0 9; cycle with I; rapid 5 0 9; rapid 5 0 2; feed 5 0 -1; rapid 5 0 9; ");
  for (const char* text : {"G81 X5 R2 Z-8 I-4", "G81 X5 Z2 I-8 J1", "G82 X5 Z2 I-8",
                           "G83 X5 R2 Z-8 Q1 I3", "G84 X5 R2 Z-8 J3"}) {
    EXPECT_EQ(complaint_ids("G0 X0 Y0 Z9 F50 M3 S9\n" + std::string(text) + "\n"),
              std::vector<std::string>{"word-unused"})
        << text;
  }
  EXPECT_EQ(complaint_ids("G0 X0 Y0 Z9 F50\nG81 X5 Z2 I-8 K5\n"),
            std::vector<std::string>{"word-ambiguous"});
}

TEST(FanucCycle, LeavesTheHoleWhenTheOperatorHasDrawnTheToolBack) {
  EXPECT_EQ(steps("S500 M3\nG0 X0 Y0 Z20\nG98 G88 X10 Y0 R2 Z-5 P1000 F50\nX20\nG80\nG0 X50\n"),
            "on; rapid 0 0 20; G88; rapid 10 0 20; rapid 10 0 2; feed 10 0 -5; dwell 1; off; "
            "rapid 10 0 2; on; rapid 10 0 20; rapid 20 0 20; rapid 20 0 2; feed 20 0 -5; dwell 1; "
            "off; rapid 20 0 2; on; rapid 20 0 20; rapid 50 0 20; ");
}

TEST(FanucCycle, GoesToTheHoleAtTheHeightWhereTheToolIs) {
  // From Z2 to a hole of R5: above the hole first, then up.
  EXPECT_EQ(steps("G0 X0 Y0 Z2\nG99 G81 X50 R5 Z-5 F100\nG80\n"),
            "rapid 0 0 2; rapid 50 0 2; rapid 50 0 5; feed 50 0 -5; rapid 50 0 5; ");
}

// G70, G71 and G72 of Haas, whose I J K are none of the cycle's.
TEST(FanucCycle, DrillsOnACircleAnArcAndALine) {
  const auto holes = [](std::string_view text) {
    std::vector<std::array<double, 2>> found;
    for (const LinearFeed& down : all_of<LinearFeed>(motions(text))) {
      found.push_back({*down.end[X], *down.end[Y]});
    }
    return found;
  };
  const auto expect = [](const std::vector<std::array<double, 2>>& found,
                         const std::vector<std::array<double, 2>>& wanted) {
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i][0], wanted[i][0], 1e-9) << i;
      EXPECT_NEAR(found[i][1], wanted[i][1], 1e-9) << i;
    }
  };
  const std::string start = "G0 X10 Y20 Z9\nG81 R2 Z-9 F50 L0\n";
  expect(holes(start + "G70 I5. J90. L4\nG80\n"), {{10, 25}, {5, 20}, {10, 15}, {15, 20}});
  expect(holes(start + "G71 I5. J0 K-90. L2\nG80\n"), {{15, 20}, {10, 15}});
  expect(holes(start + "G72 I5. J90. L3\nG80\n"), {{10, 20}, {10, 25}, {10, 30}});
  expect(holes("G0 X10 Y20 Z9\nG99 G81 R2 Z-9 F50 X0 Y0 G70 I2. L2\nX7\nG80\n"),
         {{2, 0}, {-2, 0}, {7, 0}});
}

// A row of holes: R and Z keep the meaning of the block that gave them.
TEST(FanucCycle, KeepsItsLevelsWhenTheModeOfDistanceChanges) {
  EXPECT_EQ(steps("G0 X0 Y0 Z100\nS1 M3\nG99 G81 X1 Z-10 R2 F10\nG91 X10 K2\n"),
            "rapid 0 0 100; on; rapid 1 0 100; rapid 1 0 2; feed 1 0 -10; rapid 1 0 2; "
            "rapid 11 0 2; feed 11 0 -10; rapid 11 0 2; rapid 21 0 2; feed 21 0 -10; "
            "rapid 21 0 2; ");
  EXPECT_EQ(steps("G0 X0 Y0 Z100\nS1 M3\nG91 G99 G81 X1 Z-5 R-98 F10\nG90 X10\n"),
            "rapid 0 0 100; on; rapid 1 0 100; rapid 1 0 2; feed 1 0 -3; rapid 1 0 2; "
            "rapid 10 0 2; feed 10 0 -3; rapid 10 0 2; ");
}

TEST(FanucCycle, RepeatsByK) {
  EXPECT_EQ(
      all_of<LinearFeed>(motions("G0 X0 Y0 Z9\nG91 G99 G81 X10 R-7 Z-5 K3 F50\nG80\n")).size(), 3U);
  const auto taps = all_of<Event>(motions("G0 X0 Y0 Z9\nM29 S500\nG84 R2 Z-5 F500\n"));
  ASSERT_EQ(taps.size(), 2U);
  EXPECT_EQ(taps[0].name, "M29");
  EXPECT_EQ(taps[1].name, "rigid tap");
  EXPECT_EQ(taps[1].grade, EventGrade::assumed);
}

}  // namespace
}  // namespace frustum::parser
