// Programs that do not end, or go where no machine does: the check ends.
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "tests/lint/checking.hpp"

namespace frustum::lint {
namespace {

using parser::Dialect;

CheckReport checked_as_shipped(const std::string& text, CheckOptions options = {},
                               Dialect dialect = Dialect::linuxcnc) {
  return check_program({"part.ngc", dialect, parser::ProgramText(text), nullptr}, options);
}

TEST(Limits, Fault2_17_LoopsWithoutEndAreBrokenOff) {
  for (const char* body : {"o1 do\no1 while [1]\n", "o1 do\nG91 G0 X1\no1 while [1]\n",
                           "o1 while [1]\n#1=[#1*2+1]\nG91 G0 X#1\no1 endwhile\n",
                           "o1 do\no2 do\no2 while [1]\no1 while [1]\n"}) {
    const CheckReport report =
        checked_as_shipped("#1=0\nG0 X0 Y0 Z5\n" + std::string(body) + "M2\n");
    EXPECT_LE(report.blocks, 2'000'000U) << body;
    EXPECT_FALSE(of(report, "endless-loop").empty() && of(report, "program-error").empty())
        << body << ids(report);
  }
}

TEST(Limits, Fault2_17_LoopsOfManyBlocksToo) {
  std::string text = "G0 X0\no1 while [1]\n";
  for (int i = 0; i < 200; ++i) text += "G0 X" + std::to_string(i) + "\n";
  const CheckReport report = checked_as_shipped(text + "o1 endwhile\nM2\n");
  EXPECT_LE(report.blocks, 1'100'000U);
  const auto found = of(report, "endless-loop");
  ASSERT_EQ(found.size(), 1U) << ids(report);
  EXPECT_EQ(found[0].severity, Severity::warning);
}

TEST(Limits, ALongProgramWithoutLoopsRunsToItsEnd) {
  std::string text = "G0 X0 Z5\n";
  for (int i = 0; i < 3000; ++i) text += "G0 X" + std::to_string(i % 7) + "\n";
  CheckOptions options;
  options.most_repeats = 100;
  EXPECT_EQ(ids(checked_as_shipped(text + "M2\n", options)), "");
}

TEST(Limits, SubprogramsThatComeOnceAreNoRepeats) {
  CheckOptions options;
  options.most_repeats = 10;
  const std::string text =
      "G21 G0 X0 Z5\nM98 P2\nM98 P1\nG0 X3\nM30\nO1\nG0 X1\nM99\nO2\nG0 X2\nM99\n";
  EXPECT_EQ(ids(checked_as_shipped(text, options, Dialect::fanuc)), "");
}

TEST(Limits, Fault2_17_MovesBeyondAnyMachineAreLookedAtInFewParts) {
  const kinematics::Machine machine = shipped("iwf-bc");
  CheckOptions options;
  options.machine = &machine;
  options.setup.tools[1].length = 100.0;
  std::string text = "T1 M6\nS1000 M3\nG43.4 H1\nG0 X0 Y0 Z50 B0 C0\n";
  for (int i = 0; i < 200; ++i) text += i % 2 == 0 ? "X4294967296 C1\n" : "X0 C99999999\n";
  const CheckReport report = checked_as_shipped(text + "G49\nM5\nM30\n", options, Dialect::fanuc);
  EXPECT_FALSE(of(report, "over-travel").empty()) << ids(report);
}

TEST(Limits, Fault2_16_NoFindingHasNaN) {
  const kinematics::Machine machine = shipped("iwf-bc");
  CheckOptions options;
  options.machine = &machine;
  for (const char* text : {"G17\nG1 e3 X-1.5 Y0.\nG02 X1.5 Y0 I1.5 J0 F100\nM2\n",
                           "G17\nG1 X-1.5 Y0.\nG02 X1.5 Y0 I1.5 J0 F100\nM2\n"}) {
    for (const Finding& finding : checked_as_shipped(text, options).findings) {
      EXPECT_EQ(finding.message.find("nan"), std::string::npos) << finding.message;
    }
  }
}

TEST(Limits, Fault2_18_TipControlOffIsSeenFromHomeOn) {
  const kinematics::Machine machine = shipped("iwf-bc");
  CheckOptions options;
  options.machine = &machine;
  const std::string text = "T1 M6\nS1000 M3\nG43 H1\nG0 Z50\nG1 B30 X40 F500\nG0 Z99\nM5\nM30\n";
  EXPECT_TRUE(of(checked_as_shipped(text, options, Dialect::fanuc), "tip-control-off").empty());
  for (const parser::AxisLetter axis : parser::kAxisLetters) options.home[axis] = 0.0;
  const auto found = of(checked_as_shipped(text, options, Dialect::fanuc), "tip-control-off");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].line, 5U);
}

}  // namespace
}  // namespace frustum::lint
