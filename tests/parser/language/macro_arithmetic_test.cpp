// What Custom Macro computes otherwise than RS-274, its system variables and its output statements.
#include <gtest/gtest.h>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

double macro_value(const std::string& expression) {
  return *last_of<Traverse>(motions("#1=7\nG0 X" + expression + "\n")).end[X];
}
struct ArithmeticCase {
  const char* text;
  double value;
};

TEST(MacroArithmetic, CombinesBits) {
  for (const ArithmeticCase& c : {
           ArithmeticCase{"[12 AND 10]", 8},
           ArithmeticCase{"[12 OR 10]", 14},
           ArithmeticCase{"[12 XOR 10]", 6},
           ArithmeticCase{"[-1 AND 255]", 255},
           // AND is a product, OR and XOR are sums.
           ArithmeticCase{"[1+6 AND 3]", 3},
           ArithmeticCase{"[8 OR 1+1]", 10},
           ArithmeticCase{"[2*3 AND 2]", 2},
           ArithmeticCase{"[[1 EQ 1] AND [2 EQ 2]]", 1},
           ArithmeticCase{"[[1 EQ 1] AND [2 EQ 3]]", 0},
           ArithmeticCase{"[[1 EQ 2] OR [#1 GT 5]]", 1},
           ArithmeticCase{"[1 EQ 3 AND 1]", 1},
       }) {
    EXPECT_EQ(macro_value(c.text), c.value) << c.text;
  }
}

TEST(MacroArithmetic, RoundsTowardsZeroAndAway) {
  for (const ArithmeticCase& c : {
           ArithmeticCase{"FIX[1.2]", 1},
           ArithmeticCase{"FIX[-1.2]", -1},
           ArithmeticCase{"FUP[1.2]", 2},
           ArithmeticCase{"FUP[-1.2]", -2},
           ArithmeticCase{"[7 MOD 4]", 3},
           ArithmeticCase{"[-7 MOD 4]", -3},
           ArithmeticCase{"[7 MOD -4]", 3},
           ArithmeticCase{"[7.4 MOD 4.4]", 3},
       }) {
    EXPECT_EQ(macro_value(c.text), c.value) << c.text;
  }
}

TEST(MacroArithmetic, HasFunctionsOfItsOwn) {
  for (const ArithmeticCase& c : {
           ArithmeticCase{"POW[2,10]", 1024},
           ArithmeticCase{"POW[[1+1],#1-4]", 8},
           ArithmeticCase{"BCD[1234]", 4660},
           ArithmeticCase{"BIN[4660]", 1234},
           ArithmeticCase{"BIN[BCD[99999999]]", 99999999},
           ArithmeticCase{"ADP[10]", 10},
           ArithmeticCase{"ATAN[1]", 45},
           ArithmeticCase{"ATAN[-1]", -45},
           ArithmeticCase{"[ATAN[1]+1]", 46},
           ArithmeticCase{"ATAN[1]/[-1]", 135},
           ArithmeticCase{"ATAN[1,-1]", 135},
       }) {
    EXPECT_NEAR(macro_value(c.text), c.value, 1e-9) << c.text;
  }
}

TEST(MacroArithmetic, LeavesRs274Alone) {
  const auto moves = motions("G0 X[2 AND 1]\n", {}, Dialect::linuxcnc);
  EXPECT_EQ(*last_of<Traverse>(moves).end[X], 1.0);
}

TEST(SystemVariable, TellsTheModes) {
  for (const ArithmeticCase& c : {
           ArithmeticCase{"#4001", 0},
           ArithmeticCase{"#4002", 17},
           ArithmeticCase{"#4003", 90},
           ArithmeticCase{"#4005", 94},
           ArithmeticCase{"#4006", 21},
           ArithmeticCase{"#4008", 49},
           ArithmeticCase{"#4009", 80},
           ArithmeticCase{"#4010", 98},
           ArithmeticCase{"#4011", 50},
           ArithmeticCase{"#4013", 97},
           ArithmeticCase{"#4014", 54},
           ArithmeticCase{"#4016", 69},
           ArithmeticCase{"#4017", 15},
           ArithmeticCase{"#4022", 50.1},
           ArithmeticCase{"#4109", 0},
           ArithmeticCase{"#4119", 0},
           ArithmeticCase{"#4120", 0},
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
