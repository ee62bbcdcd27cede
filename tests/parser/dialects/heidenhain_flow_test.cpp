// Q parameters, labels, subprograms and repeats of Klartext programs.
#include <gtest/gtest.h>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<double> x_of_klartext(std::string_view text) {
  std::vector<double> places;
  for (const Traverse& move : all_of<Traverse>(motions(text, {}, Dialect::heidenhain))) {
    places.push_back(*move.end[X]);
  }
  return places;
}

TEST(HeidenhainFlow, ComputesWithParameters) {
  EXPECT_EQ(x_of_klartext(
                "FN 0: Q1 = +6\nFN 1: Q2 = +Q1 + -2\nFN 2: Q3 = +Q2 - +1\nFN 3: Q4 = -Q3 * +2\n"
                "FN 4: Q5 = +Q4 DIV +3\nL X+Q1 R0 FMAX\nL X+Q2 FMAX\nL X+Q3 FMAX\nL X-Q4 FMAX\nL "
                "X+Q5 FMAX\n"),
            (std::vector<double>{6, 4, 3, 6, -2}));
  EXPECT_EQ(x_of_klartext("Q1 = (2 + 3) * 4 - SQRT 16 / 2\nL X+Q1 FMAX\nL IX-Q1 FMAX\n"),
            (std::vector<double>{18, 0}));
  EXPECT_EQ(x_of_klartext("Q1 = 3 * 2 ^ 2 + 1\nL X+Q1 FMAX\n"), (std::vector<double>{13}));
  const auto found = x_of_klartext(
      "FN 6: Q1 = SIN +30\nFN 7: Q2 = COS +60\nFN 5: Q3 = SQRT +9\nL X+Q1 FMAX\nL X+Q2 FMAX\n"
      "L X+Q3 FMAX\n");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NEAR(found[0], 0.5, 1e-15);
  EXPECT_NEAR(found[1], 0.5, 1e-15);
  EXPECT_NEAR(found[2], 3.0, 1e-15);
}

TEST(HeidenhainFlow, RepeatsAPart) {
  EXPECT_EQ(x_of_klartext("L X+0 FMAX\nLBL 1\nL IX+1 FMAX\nCALL LBL 1 REP 2\nL X+9 FMAX\n"),
            (std::vector<double>{0, 1, 2, 3, 9}));
  EXPECT_EQ(x_of_klartext(
                "L X+0 FMAX\nLBL 1\nLBL 2\nL IX+1 FMAX\nCALL LBL 2 REP 1\nL IX+10 FMAX\nCALL LBL "
                "1 REP 1\n"),
            (std::vector<double>{0, 1, 2, 12, 13, 14, 24}));
}

TEST(HeidenhainFlow, CallsSubprograms) {
  EXPECT_EQ(x_of_klartext("L X+0 FMAX\nCALL LBL 1\nCALL LBL \"SLOT\"\nCALL LBL 1\nL X+9 FMAX M30\n"
                          "LBL 1\nL IX+1 FMAX\nLBL 0\nLBL \"SLOT\"\nL IX+5 FMAX\nLBL 0\n"),
            (std::vector<double>{0, 1, 6, 7, 9}));
}

TEST(HeidenhainFlow, PassesASubprogramThatWasNotCalled) {
  EXPECT_EQ(x_of_klartext("LBL 1\nL X+1 FMAX\nLBL 0\nL X+2 FMAX\n"), (std::vector<double>{1, 2}));
}

TEST(HeidenhainFlow, Jumps) {
  EXPECT_EQ(
      x_of_klartext(
          "FN 0: Q1 = +0\nLBL 5\nFN 1: Q1 = +Q1 + +1\nL X+Q1 FMAX\nFN 12: IF +Q1 LT +3 GOTO LBL 5\n"
          "FN 9: IF +Q1 EQU +3 GOTO LBL 6\nL X+99 FMAX\nLBL 6\nFN 10: IF +Q1 NE +3 GOTO LBL 5\n"
          "FN 11: IF +Q1 GT +3 GOTO LBL 5\nL X+7 FMAX\n"),
      (std::vector<double>{1, 2, 3, 7}));
}

struct FlowMistake {
  const char* text;
  const char* complaint;
};
class HeidenhainFault : public testing::TestWithParam<FlowMistake> {};

TEST_P(HeidenhainFault, IsToldWithItsPlace) {
  const auto lines = complaints(GetParam().text, {.max_blocks = 500}, Dialect::heidenhain);
  ASSERT_FALSE(lines.empty()) << GetParam().text;
  EXPECT_EQ(lines[0].substr(0, lines[0].find(" (hint:")), GetParam().complaint);
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, HeidenhainFault,
    testing::Values(
        FlowMistake{"L X+Q7 FMAX\n", "1:5: error: parameter Q7 has no value"},
        FlowMistake{"LBL\n", "1:4: error: LBL has no number or name"},
        FlowMistake{"LBL 1\nLBL 1\nFN 9: IF +1 EQU +1 GOTO LBL 1\n",
                    "2:1: error: 1 is already on line 1"},
        FlowMistake{"CALL LBL 9\n", "1:1: error: no subprogram 9"},
        FlowMistake{"CALL PGM PART.H\n", "1:10: error: there is no program PART"},
        FlowMistake{"CALL PGM\n", "1:9: error: the call names no program"},
        FlowMistake{"CALL PGM TNC:\\A\\.H\n", "1:10: error: the call names no program"},
        FlowMistake{"CALL PGM ..\n", "1:10: error: the call names no program"},
        FlowMistake{"CALL PGM \"A.H\n", "1:10: error: the name is not closed"},
        FlowMistake{"CALL PGM A.I\n", "1:10: error: a program .I is called from Klartext"},
        FlowMistake{"CALL SELECTED PGM\n", "1:1: error: CALL SELECTED is not simulated"},
        FlowMistake{"CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1\n",
                    "2:14: error: the call names no program"},
        FlowMistake{"CYCL DEF 12.1 PGM A.H\nL X+0 FMAX M99\n",
                    "2:12: error: there is no program A"},
        FlowMistake{"CALL LBL 4 REP 2\n", "1:1: error: there is no part 4 to repeat"},
        FlowMistake{"CALL LBL 1\nM30\nLBL 1\nL X+1 FMAX\n",
                    "3:1: error: subprogram 1 has no LBL 0"},
        FlowMistake{"FN 9: IF +1 EQU +1 GOTO LBL 3\n", "1:1: error: there is no 3 to go to"},
        FlowMistake{"FN 9: IF +1 ISO +1 GOTO LBL 3\n",
                    "1:13: error: FN compares by EQU, NE, GT or LT"},
        FlowMistake{"FN 17: SYSWRITE ID 1\n", "1:1: error: FN 17 is not simulated"},
        FlowMistake{"FN 4: Q1 = +1 DIV +0\n", "1:15: error: division of 1 by zero"},
        FlowMistake{"FN 1: Q1 = +1\n", "1:14: error: FN 1 has no +"},
        FlowMistake{"FN Q1 = +1\n", "1:1: error: FN has no number"},
        FlowMistake{"Q1 + 2\n", "1:4: error: Q1 has no ="},
        FlowMistake{"Q1 = (2 + 3\n", "1:6: error: the bracket is not closed"},
        FlowMistake{"Q1 = FOO\n", "1:6: error: FOO is no parameter and no function"}));

}  // namespace
}  // namespace frustum::parser
