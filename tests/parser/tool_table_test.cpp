// Tool table files, and programs that refer to them.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/units.hpp"
#include "parser/tool_table.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

ToolTable table(std::string_view text, LengthUnit unit = LengthUnit::millimetre) {
  auto tools = tool_table_of(text, "tools.tbl", unit);
  if (tools) return *std::move(tools);
  ADD_FAILURE() << to_string(tools.error().front());
  return {};
}

std::vector<std::string> faults(std::string_view text) {
  const auto tools = tool_table_of(text, "tools.tbl");
  std::vector<std::string> lines;
  if (tools) return lines;
  for (const Diagnostic& fault : tools.error()) {
    const std::string line = to_string(fault);
    EXPECT_TRUE(line.starts_with("tools.tbl:")) << line;
    const std::size_t hint = line.find(" (hint: ");
    EXPECT_NE(hint, std::string::npos) << line;
    lines.push_back(line.substr(10, hint - 10));
  }
  return lines;
}

TEST(ToolTable, HasEveryWordOfALine) {
  const ToolTable tools = table(
      ";a remark alone\n\nT1 P2 D10.0 X1 Y-2 Z+50.5 A90 I10 J80 Q3 U0 V0 W0 ;end mill, 4 teeth\r\n"
      "t12 p3 z20\n");
  ASSERT_EQ(tools.size(), 2U);
  const Tool& first = tools.at(1);
  EXPECT_EQ(first.pocket, 2);
  EXPECT_EQ(first.diameter, 10.0);
  EXPECT_EQ(first.offset[0], 1.0);
  EXPECT_EQ(first.offset[1], -2.0);
  EXPECT_EQ(first.offset[2], 50.5);
  EXPECT_NEAR(first.offset[3], 90.0 * kRadPerDeg, 1e-15);
  EXPECT_EQ(first.front_angle, 10.0);
  EXPECT_EQ(first.back_angle, 80.0);
  EXPECT_EQ(first.orientation, 3);
  EXPECT_EQ(first.remark, "end mill, 4 teeth");
  EXPECT_EQ(tools.at(12).offset[2], 20.0);
}

TEST(ToolTable, CountsLengthsInInchesWhereTheMachineDoes) {
  const Tool tool = table("T1 P1 D0.5 Z2 A10\n", LengthUnit::inch).at(1);
  EXPECT_NEAR(tool.diameter, 12.7, 1e-12);
  EXPECT_NEAR(tool.offset[2], 50.8, 1e-12);
  EXPECT_NEAR(tool.offset[3], 10.0 * kRadPerDeg, 1e-15);
}

TEST(ToolTable, SaysWhereItIsWrong) {
  struct Case {
    const char* text;
    const char* fault;
  };
  for (const Case& c : {
           Case{"P1 Z5\n", "1:1: error: a line without a tool number"},
           Case{"T1 P1\nT2 P2 Z5x\n", "2:9: error: 'x' has no number"},
           Case{"T1 Z\n", "1:4: error: 'Z' has no number"},
           Case{"T1 Z+-5\n", "1:4: error: 'Z+-5' has no number"},
           Case{"T1 Z5 Z6\n", "1:7: error: Z is twice on the line"},
           Case{"T1 F5\n", "1:4: error: 'F5' is no word of a tool table"},
           Case{"T1 (end mill)\n", "1:4: error: '(end' is no word of a tool table"},
           Case{"T1.5 Z1\n", "1:1: error: T1.5 is no tool number"},
           Case{"T-1 Z1\n", "1:1: error: T-1 is no tool number"},
           Case{"T1 P-1\n", "1:4: error: P-1 is not a whole number"},
           Case{"T1 Q10\n", "1:4: error: orientation 10 does not exist"},
           Case{"T1 U5\n", "1:4: error: an offset along U is not simulated"},
           Case{"T1 Z1e999\n", "1:6: error: 'e999' is no word of a tool table"},
           Case{"T99999999999\n", "1:1: error: T is too large"},
           Case{"T1\n\nT1 Z5\n", "3:1: error: tool 1 is described twice"},
           Case{"T1 \xE4\n", "1:4: error: '?' is no word of a tool table"},
       }) {
    const auto lines = faults(c.text);
    ASSERT_EQ(lines.size(), 1U) << c.text;
    EXPECT_EQ(lines.front(), c.fault);
  }
}

TEST(ToolTable, TellsAllItsMistakes) { EXPECT_EQ(faults("T1 F5\nT2 Z5\nZ5\n").size(), 2U); }

TEST(ToolTable, OfAFileThatIsNotThereIsAnError) {
  const auto tools = read_tool_table("/nowhere/tools.tbl");
  ASSERT_FALSE(tools);
  EXPECT_EQ(tools.error().front().message, "the tool table cannot be read");
}

InterpreterOptions with_tools(std::string_view text) {
  InterpreterOptions options;
  options.tools = table(text);
  return options;
}

TEST(ToolTable, GivesTheLengthsOfG43) {
  const auto all =
      motions("T1 M6\nG43\nG43 H2\nG49\n", with_tools("T1 Z50\nT2 Z60.5\n"), Dialect::linuxcnc);
  const auto changes = all_of<CompensationChange>(all);
  ASSERT_EQ(changes.size(), 3U);
  EXPECT_EQ(changes[0].length, 50.0);
  EXPECT_EQ(changes[0].offset_number, 1);
  EXPECT_EQ(changes[1].length, 60.5);
  EXPECT_EQ(changes[2].length, std::nullopt);
}

TEST(ToolTable, LeavesLengthsToTheSetupWhereThereIsNone) {
  EXPECT_EQ(last_of<CompensationChange>(motions("G43 H2\n", {}, Dialect::linuxcnc)).length,
            std::nullopt);
}

TEST(ToolTable, HasTheOnlyToolsThereAre) {
  const auto options = with_tools("T1 Z50\n");
  const auto complaint = [&](std::string_view text) {
    const auto lines = complaints(text, options, Dialect::linuxcnc);
    return lines.size() == 1 ? lines.front().substr(0, lines.front().find(" (hint: "))
                             : std::string("no complaint");
  };
  EXPECT_EQ(complaint("G0 X1\nT9 M6\n"), "2:1: error: tool 9 is not in the tool table");
  EXPECT_EQ(complaint("G43 H9\n"), "1:5: error: tool 9 is not in the tool table");
  EXPECT_EQ(complaint("G43.1 Z1\nG43.2 H9\n"), "2:7: error: tool 9 is not in the tool table");
  EXPECT_EQ(complaint("M61 Q9\n"), "1:5: error: tool 9 is not in the tool table");
  EXPECT_EQ(complaint("G10 L1 P9 Z1\n"), "1:8: error: tool 9 is not in the tool table");
  EXPECT_EQ(complaint("G10 L10 P9 Z1\n"), "1:9: error: tool 9 is not in the tool table");
  EXPECT_EQ(complaint("T0 M6\nT1 M6 G43\nM61 Q0\n"), "no complaint");
}

TEST(ToolTable, IsChangedByTheProgramInItsOwnCopy) {
  const auto options = with_tools("T1 Z50 D10\n");
  const auto all = motions("G10 L1 P1 Z44\nG43 H1\n", options, Dialect::linuxcnc);
  EXPECT_EQ(last_of<CompensationChange>(all).length, 44.0);
  EXPECT_EQ(options.tools.at(1).offset[2], 50.0);
}

}  // namespace
}  // namespace frustum::parser
