#include "parser/language/expression.hpp"
#include "core/decimal.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <charconv>
#include <limits>

#include "parser/reading/rs274/grammar.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

double value_of(const std::string& expression) {
  return last_of<Traverse>(
             motions("#1=7 #<depth>=-2.5\nG0 X" + expression + "\n", {}, Dialect::linuxcnc))
      .end[AxisLetter::X]
      .value_or(std::numeric_limits<double>::quiet_NaN());
}

struct Case {
  const char* text;
  double value;
};

// Values by RS-274's rules: left to right within a level, the sign belongs to the number.
TEST(Expression, HasTheValueRs274Gives) {
  for (const Case& c : {
           Case{"[1+2*3]", 7},
           Case{"[[1+2]*3]", 9},
           Case{"[2**3**2]", 64},
           Case{"[-2**2]", 4},
           Case{"[10-4-3]", 3},
           Case{"[100/10/5]", 2},
           Case{"[2*3**2]", 18},
           Case{"[7 MOD 4]", 3},
           Case{"[-7 MOD 4]", 1},
           Case{"[-7 mod -4]", 1},
           Case{"[1--2]", 3},
           Case{"[1 - -2]", 3},
           Case{"[+5]", 5},
           Case{"-[5]", -5},
           Case{"-#1", -7},
           Case{"#1", 7},
           Case{"#[3+4-6]", 7},
           Case{"#<depth>", -2.5},
           Case{"#< D e p t h >", -2.5},
           Case{"-#<depth>", 2.5},
           Case{"[#1*#1]", 49},
           Case{"SQRT[16]", 4},
           Case{"sqrt[16]", 4},
           Case{"ABS[-3]", 3},
           Case{"ROUND[2.5]", 3},
           Case{"ROUND[-2.5]", -3},
           Case{"FIX[2.8]", 2},
           Case{"FIX[-2.8]", -3},
           Case{"FUP[2.2]", 3},
           Case{"FUP[-2.8]", -2},
           Case{"LN[1]", 0},
           Case{"EXP[0]", 1},
           Case{"-SQRT[9]", -3},
           Case{"[2+SQRT[9]*2]", 8},
           Case{"[.5+1.]", 1.5},
       }) {
    EXPECT_EQ(value_of(c.text), c.value) << c.text;
  }
}

TEST(Expression, TakesAndGivesDegrees) {
  for (const Case& c :
       {Case{"SIN[30]", 0.5}, Case{"COS[60]", 0.5}, Case{"TAN[45]", 1}, Case{"ASIN[.5]", 30},
        Case{"ACOS[.5]", 60}, Case{"ATAN[1]/[1]", 45}, Case{"ATAN[1]/[-1]", 135},
        Case{"ATAN[-1,-1]", -135}, Case{"ATAN[0]/[1]", 0}, Case{"LN[EXP[2]]", 2}}) {
    EXPECT_NEAR(value_of(c.text), c.value, 1e-13) << c.text;
  }
}

TEST(Expression, ReadsParametersAsTheBlocksBeforeLeftThem) {
  const auto moves = all_of<Traverse>(motions("#1=5\n#1=6 G0 X#1\nG0 X#1\n"));
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[0].end[AxisLetter::X], 5.0);
  EXPECT_EQ(moves[1].end[AxisLetter::X], 6.0);
}

TEST(Expression, ComputesSettingsWithoutBracketsToo) {
  EXPECT_EQ(last_of<Traverse>(motions("#1=2+3*4\n##1=SQRT[#1+2]\nG0 X#14\n")).end[AxisLetter::X],
            4.0);
}

TEST(Expression, MayGiveTheNumberOfAWord) {
  const auto arc = last_of<ArcFeed>(motions("#1=2\nG0 X0 Y0\nG#1 X10 I5 F100\n"));
  EXPECT_EQ(arc.turns, -1);
}

TEST(Expression, NestsAsDeeplyAsItPromises) {
  const std::string open(kMaxExpressionDepth, '[');
  const std::string close(kMaxExpressionDepth, ']');
  EXPECT_EQ(value_of(open + "1" + close), 1.0);
  // The worst case for the stack: every bracket inside a sum, a product and a power.
  std::string text = "1";
  for (int i = 0; i < kMaxExpressionDepth; ++i) text = "[1+1*1**" + text + "]";
  EXPECT_EQ(value_of(text), 2.0);
  // ... and inside the second argument of ATAN, which holds the first one back.
  text = "1";
  for (int i = 0; i < kMaxExpressionDepth; ++i) text = "ATAN[1]/[0+1*1**" + text + "]";
  EXPECT_TRUE(std::isfinite(value_of(text)));
}

RC_GTEST_PROP(ExpressionLaws, DecimalTextReadsBackExactly, (double value)) {
  RC_PRE(std::isfinite(value));
  const std::string text = shortest_decimal(value);
  RC_ASSERT(text.find_first_of("eE") == std::string::npos);
  double read = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), read);
  RC_ASSERT(read == value);
}

}  // namespace
}  // namespace frustum::parser
