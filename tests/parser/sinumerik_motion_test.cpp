// Rotary words and directions of Sinumerik, places about a pole, arcs through a point and tangential ones, threads.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run(std::string_view text) { return motions(text, {}, Dialect::sinumerik); }

std::vector<RotaryPathChange> paths_of(std::string_view text) {
  return all_of<RotaryPathChange>(run(text));
}

TEST(SinumerikRotary, TurnsInTheDirectionThatAWordAsksFor) {
  const auto up = paths_of("G0 C=ACP(10)\n");
  ASSERT_EQ(up.size(), 1U);
  EXPECT_EQ(up[0].path, RotaryPath::positive);
  EXPECT_EQ(up[0].axes, (std::array{false, false, true}));
  EXPECT_DOUBLE_EQ(*last_of<Traverse>(run("G0 C=ACP(10)\n")).end[C], 10 * kRadPerDeg);
  EXPECT_EQ(paths_of("G0 B=ACN(10)\n").at(0).path, RotaryPath::negative);
  // Each axis has its own way; equal ones are told together.
  const auto both = paths_of("G0 A=DC(1) B=ACP(2) C=DC(3)\n");
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].path, RotaryPath::shortest);
  EXPECT_EQ(both[0].axes, (std::array{true, false, true}));
  EXPECT_EQ(both[1].axes, (std::array{false, true, false}));
  // A value without a way turns to that value again.
  EXPECT_EQ(paths_of("G0 C=ACP(10)\nC=AC(20)\n").at(1).path, RotaryPath::as_programmed);
  EXPECT_EQ(paths_of("G0 C=ACP(10)\nC=ACP(20)\n").size(), 1U);
  // The full turns are not known any more.
  EXPECT_FALSE(last_of<Traverse>(run("G0 C=ACN(10)\nX1\n")).end[C].has_value());
}

TEST(SinumerikRotary, StepsGoOnFromWhereTheAxisIs) {
  const auto last_path = [](const std::string& step) {
    return paths_of("G0 C=ACP(10)\nC5\nC=DC(350)\n" + step).back().path;
  };
  EXPECT_EQ(last_path("C=IC(-180)\n"), RotaryPath::shortest);
  EXPECT_EQ(last_path("C=IC(270)\n"), RotaryPath::positive);
  EXPECT_EQ(last_path("G91 C-270\n"), RotaryPath::negative);
  EXPECT_EQ(last_path("G91 C20\n"), RotaryPath::shortest);
  EXPECT_DOUBLE_EQ(*last_of<Traverse>(run("G0 C=DC(350)\nG91 C270\n")).end[C], 620 * kRadPerDeg);
}

TEST(SinumerikOrientation, OfTheMachineIsThatOfTheWordsWhileNoFrameTurnsThem) {
  const std::string head = "T1 D1 M6\nTRAORI\nG0 X0 Y0 Z0\n";
  const std::string vector = "G1 X5 A3=0.6 B3=0 C3=0.8 F100\n";
  const auto without = run(head + vector);
  for (const char* frame : {"", "TRANS X10\n", "ATRANS Z5\n", "G55\n"}) {
    const auto all = run(head + "ORIMKS\n" + frame + vector);
    EXPECT_EQ(last_of<LinearFeed>(all).tool_axis->vec(),
              last_of<LinearFeed>(without).tool_axis->vec());
    EXPECT_TRUE(all_of<OrientationPathChange>(all).empty());
  }
  // Told, not silent; the workpiece's frame comes back.
  const auto told = all_of<Event>(run("ORIMKS\nORIWKS\n"));
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].name, "ORIMKS");
  EXPECT_EQ(told[1].name, "ORIWKS");
  EXPECT_TRUE(run(head + "ORIMKS\nORIWKS\nROT Z30\nG0 X0 Y0 Z0\nA3=0 C3=1\n").size() > 5);
  // Rotary words are of the machine in any frame.
  EXPECT_DOUBLE_EQ(*last_of<Traverse>(run(head + "ORIMKS\nROT Z30\nG0 X0 Y0 Z0 B5\n")).end[B],
                   5 * kRadPerDeg);
}

}  // namespace
}  // namespace frustum::parser
