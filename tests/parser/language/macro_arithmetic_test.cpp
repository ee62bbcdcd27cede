// What Custom Macro computes otherwise than RS-274, its system variables and its output statements.
#include <gtest/gtest.h>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

double value_of(const std::string& expression) {
  return *last_of<Traverse>(motions("#1=7\nG0 X" + expression + "\n")).end[X];
}
struct Case {
  const char* text;
  double value;
};

TEST(MacroArithmetic, CombinesBits) {
  for (const Case& c : {
           Case{"[12 AND 10]", 8},
           Case{"[12 OR 10]", 14},
           Case{"[12 XOR 10]", 6},
           Case{"[-1 AND 255]", 255},
           // AND is a product, OR and XOR are sums.
           Case{"[1+6 AND 3]", 3},
           Case{"[8 OR 1+1]", 10},
           Case{"[2*3 AND 2]", 2},
           Case{"[[1 EQ 1] AND [2 EQ 2]]", 1},
           Case{"[[1 EQ 1] AND [2 EQ 3]]", 0},
           Case{"[[1 EQ 2] OR [#1 GT 5]]", 1},
           Case{"[1 EQ 3 AND 1]", 1},
       }) {
    EXPECT_EQ(value_of(c.text), c.value) << c.text;
  }
}

TEST(MacroArithmetic, RoundsTowardsZeroAndAway) {
  for (const Case& c : {
           Case{"FIX[1.2]", 1},
           Case{"FIX[-1.2]", -1},
           Case{"FUP[1.2]", 2},
           Case{"FUP[-1.2]", -2},
           Case{"[7 MOD 4]", 3},
           Case{"[-7 MOD 4]", -3},
           Case{"[7 MOD -4]", 3},
           Case{"[7.4 MOD 4.4]", 3},
       }) {
    EXPECT_EQ(value_of(c.text), c.value) << c.text;
  }
}

TEST(MacroArithmetic, HasFunctionsOfItsOwn) {
  for (const Case& c : {
           Case{"POW[2,10]", 1024},
           Case{"POW[[1+1],#1-4]", 8},
           Case{"BCD[1234]", 4660},
           Case{"BIN[4660]", 1234},
           Case{"BIN[BCD[99999999]]", 99999999},
           Case{"ADP[10]", 10},
           Case{"ATAN[1]", 45},
           Case{"ATAN[-1]", -45},
           Case{"[ATAN[1]+1]", 46},
           Case{"ATAN[1]/[-1]", 135},
           Case{"ATAN[1,-1]", 135},
       }) {
    EXPECT_NEAR(value_of(c.text), c.value, 1e-9) << c.text;
  }
}

TEST(MacroArithmetic, LeavesRs274Alone) {
  const auto moves = motions("G0 X[2 AND 1]\n", {}, Dialect::linuxcnc);
  EXPECT_EQ(*last_of<Traverse>(moves).end[X], 1.0);
}

TEST(SystemVariable, TellsTheModes) {
  for (const Case& c : {
           Case{"#4001", 0},
           Case{"#4002", 17},
           Case{"#4003", 90},
           Case{"#4005", 94},
           Case{"#4006", 21},
           Case{"#4008", 49},
           Case{"#4009", 80},
           Case{"#4010", 98},
           Case{"#4011", 50},
           Case{"#4013", 97},
           Case{"#4014", 54},
           Case{"#4016", 69},
           Case{"#4017", 15},
           Case{"#4022", 50.1},
           Case{"#4109", 0},
           Case{"#4119", 0},
           Case{"#4120", 0},
       }) {
    EXPECT_EQ(*last_of<Traverse>(motions("G0 Y0\nX" + std::string(c.text) + "\n")).end[X], c.value)
        << c.text;
  }
  const auto read = [](const char* variable) {
    return *last_of<Traverse>(
                motions("G0 X0 Y0 Z0\nG1 F250 S3000 T7\nG18 G55 G99 G43 H3\nG0 X0 Y0 Z0\nG51 P2.\n"
                        "#100=" +
                        std::string(variable) + "\nG50 G0 X#100\n"))
                .end[X];
  };
  EXPECT_EQ(read("#4002"), 18);
  EXPECT_EQ(read("#4008"), 43);
  EXPECT_EQ(read("#4010"), 99);
  EXPECT_EQ(read("#4011"), 51);
  EXPECT_EQ(read("#4014"), 55);
  EXPECT_EQ(read("#4109"), 250);
  EXPECT_EQ(read("#4111"), 3);
  EXPECT_EQ(read("#4119"), 3000);
  EXPECT_EQ(read("#4120"), 7);
}

TEST(SystemVariable, TellsWhereTheToolIs) {
  EXPECT_EQ(*last_of<Traverse>(motions("G0 X3 Y4\nG0 X[#5001+#5042]\n")).end[X], 7.0);
}

TEST(SystemVariable, StopsWithAMessage) {
  const auto found = motions("G0 X1\n#3006=1(TURN THE PART)\nX2\n");
  EXPECT_EQ(all_of<Stop>(found).size(), 1U);
  const auto events = all_of<Event>(found);
  ASSERT_GE(events.size(), 1U);
  EXPECT_EQ(events.back().name, "message");
  EXPECT_EQ(events.back().text, "TURN THE PART");
}

TEST(SystemVariable, ReportsSwitches) {
  const auto events = all_of<Event>(motions("#3003=1\n#3004=7\n#1100=1\n"));
  ASSERT_EQ(events.size(), 3U);
  EXPECT_EQ(events[1].name, "#3004");
  EXPECT_EQ(events[1].text, "7");
}

TEST(MacroOutput, IsReportedAsItIsWritten) {
  const auto events = all_of<Event>(motions(
      "POPEN\nN10 DPRNT[X#100[53]*Y#101[53]] (to the file)\n/ BPRNT[C**X#100[3]]\nPCLOS\n"));
  ASSERT_EQ(events.size(), 5U);
  EXPECT_EQ(events[0].name, "POPEN");
  EXPECT_EQ(events[1].name, "DPRNT");
  EXPECT_EQ(events[1].text, "X#100[53]*Y#101[53]");
  EXPECT_EQ(events[2].text, "to the file");
  EXPECT_EQ(events[3].name, "BPRNT");
  EXPECT_EQ(events[4].name, "PCLOS");
}

}  // namespace
}  // namespace frustum::parser
