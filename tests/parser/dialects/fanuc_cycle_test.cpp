// The bores of Fanuc that shift the tool.
#include <gtest/gtest.h>

#include <string>

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
  const auto taps = all_of<Event>(motions("M29 S500\nM3\nG0 X0 Y0 Z9\nG84 R2 Z-5 F500\n"));
  ASSERT_EQ(taps.size(), 1U);
  EXPECT_EQ(taps[0].name, "M29");
}

}  // namespace
}  // namespace frustum::parser
