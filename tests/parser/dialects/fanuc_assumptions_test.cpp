// What a program in the manner of Fanuc leaves open, and how it is taken.
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;
using Assumptions = std::vector<std::string>;

// Their names, in order.
Assumptions assumptions_of(const std::vector<Motion>& all) {
  Assumptions names;
  for (const Event& event : all_of<Event>(all)) {
    if (event.grade == EventGrade::assumed) names.push_back(event.name);
  }
  return names;
}

TEST(FanucAssumptions, ColonWithoutANumberIsPassedOver) {
  const auto all = motions(":O1001\n: (A PART)\n:G90 G0 X5\n");
  EXPECT_EQ(assumptions_of(all), Assumptions{":"});
  EXPECT_EQ(last_of<Traverse>(all).end[X], 5.0);
  const auto numbered = motions(":N5 G90 G0 X5\n: N7 X6\nGOTO9\nX7\n:N9 X8\n");
  EXPECT_EQ(assumptions_of(numbered), Assumptions{":"});
  EXPECT_EQ(all_of<Traverse>(numbered).size(), 3U);
  EXPECT_EQ(last_of<Traverse>(numbered).end[X], 8.0);
  // With a number it is the O of a program.
  EXPECT_EQ(complaint_ids("G0 X1\n:5 G0 X5\n"), Assumptions{"program-end-missing"});
  EXPECT_EQ(complaint_ids("#1=5:\n"), Assumptions{"name-missing"});
  EXPECT_EQ(complaint_ids("G0 X1 : Y2\n"), Assumptions{"name-missing"});
  EXPECT_EQ(complaint_ids(":[1]\n"), Assumptions{"name-missing"});
}

// Neither a rapid to zero nor a dwell depends on the unit; a feed does.
TEST(FanucAssumptions, UnitIsAssumedWhereNothingGivesIt) {
  const auto run = [](std::string_view text, InterpreterOptions options = {}) {
    const Program program{"part.nc", Dialect::fanuc, ProgramText(std::string(text))};
    auto all = motions_of(program, options);
    EXPECT_TRUE(all) << text;
    return all ? *std::move(all) : std::vector<Motion>{};
  };
  const auto line_of = [](const std::vector<Motion>& all) {
    for (const Motion& motion : all) {
      const auto* event = std::get_if<Event>(&motion.command);
      if (event != nullptr && event->name == "units") return motion.place.line;
    }
    return 0U;
  };
  EXPECT_EQ(assumptions_of(run("G28 Z0\nG4 X1.\nG0 X5\nX9\n")), Assumptions{"units"});
  EXPECT_EQ(line_of(run("G28 Z0\nG4 X1.\nG0 X5\nX9\n")), 3U);
  EXPECT_EQ(line_of(run("G0 X0\nG1 X0 F100\n")), 2U);
  for (const char* word : {"G20", "G21", "G70", "G71"}) {
    EXPECT_EQ(line_of(run(std::string(word) + " G0 X5\n")), 0U) << word;
  }
  EXPECT_EQ(line_of(run("G91\n#1=#4006\nG0 X0\n")), 2U);
  EXPECT_EQ(line_of(run("G21\n#1=#4006\n")), 0U);
  for (const char* before :
       {"G68 X5 Y0 R30", "G51.1 X5", "G68.2 X5 Y0 Z0 I0 J0 K0", "#5221=5", "#12001=5", "F100",
        "G95 F0.1", "G10 L2 P1 X5", "G10 L10 P1 R50", "G52 X5", "G92 X0 Y5", "G54.1 P1 X5"}) {
    EXPECT_EQ(line_of(run("G90\n" + std::string(before) + "\nG21\n")), 2U) << before;
    EXPECT_EQ(line_of(run("G21\n" + std::string(before) + "\n")), 0U) << before;
  }
  for (const char* free : {"G68 X0 Y0 R30", "G51.1 X0", "#5224=90", "#100=5", "G93", "G4 X2.",
                           "S1000 M3", "G68.2 X0 Y0 Z0 I0 J30 K0", "G0 C90", "#13001=0"}) {
    EXPECT_EQ(line_of(run("G90\n" + std::string(free) + "\nG21\n")), 0U) << free;
  }
  InterpreterOptions options;
  options.control.unit = LengthUnit::inch;
  const auto inches = run("G0 X1. Y2.\nG1 X2. F10\nG21 X3.\n", options);
  EXPECT_TRUE(assumptions_of(inches).empty());
  EXPECT_NEAR(*all_of<Traverse>(inches).at(0).end[X], 25.4, 1e-12);
  EXPECT_NEAR(all_of<LinearFeed>(inches).at(0).feed.value, 254.0, 1e-12);
  EXPECT_EQ(all_of<LinearFeed>(inches).at(1).end[X], 3.0);
}

TEST(FanucAssumptions, ToolBeforeTheFirstTIsNone) {
  EXPECT_EQ(assumptions_of(motions("G0 X#4120\n")), Assumptions{"#4120"});
  EXPECT_TRUE(assumptions_of(motions("T3\nG0 X#4120\n")).empty());
}

// Nothing else turns an axis: C might be a chamfer.
TEST(FanucAssumptions, FirstTurnOfCWithinACutIsTold) {
  EXPECT_EQ(assumptions_of(motions("G0 X0 Y0\nG1 X10 C2. F100\nY10 C3.\n")), Assumptions{"axis C"});
  EXPECT_TRUE(assumptions_of(motions("G0 X0 Y0 C0\nG1 X10 C2. F100\n")).empty());
  EXPECT_TRUE(assumptions_of(motions("G0 X0 Y0\nG1 X10 B5 C2. F100\n")).empty());
  EXPECT_TRUE(assumptions_of(motions("G0 X0 Y0\nG0 X10 C2.\n")).empty());
}

// M6 alone changes to what the operator has prepared; with the offset behind the point of the next
// T, as Fagor has it, that T is the tool of the change.
TEST(FanucAssumptions, ToolMayComeBehindItsChange) {
  const auto prepared = motions("M6\nT1\nG0 X1\nM6\nT2\nM6\n");
  auto changes = all_of<ToolChange>(prepared);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].tool, 1);
  EXPECT_EQ(changes[1].tool, 2);
  EXPECT_EQ(assumptions_of(prepared), Assumptions{"tool before T"});
  const auto behind = motions("S9 M3\nM6\nT1.1\nG0 X1\nM3\nM6\nT9.9\nG0 X2\nT4.4 M6\n");
  changes = all_of<ToolChange>(behind);
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(changes[0].tool, 1);
  EXPECT_EQ(changes[1].tool, 9);
  EXPECT_EQ(changes[2].tool, 4);
  std::vector<bool> turns;
  for (const SpindleChange& change : all_of<SpindleChange>(behind)) {
    turns.push_back(change.direction != SpindleDirection::off);
  }
  EXPECT_EQ(turns, (std::vector<bool>{true, false, true, false}));
  EXPECT_EQ(assumptions_of(behind), (Assumptions{"tool before T", "tool with offset"}));
}

}  // namespace
}  // namespace frustum::parser
