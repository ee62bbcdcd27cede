// Custom Macro B: statements, calls with arguments, vacant parameters.
#include <gtest/gtest.h>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<double> x_of_macro(std::string_view text) {
  std::vector<double> places;
  for (const Traverse& move : all_of<Traverse>(motions(text))) places.push_back(*move.end[X]);
  return places;
}

TEST(Macro, LoopsWhileItsConditionHolds) {
  EXPECT_EQ(x_of_macro("#1=0\nWHILE[#1LT3]DO1\nG0X#1\n#1=#1+1\nEND1\nG0X9\n"),
            (std::vector<double>{0, 1, 2, 9}));
  EXPECT_EQ(
      x_of_macro(
          "#1=0\nWHILE [#1 LT 2] DO1\n#2=0\nWHILE [#2 LT 2] DO2\nG0 X[10*#1+#2]\n#2=#2+1\nEND2\n"
          "#1=#1+1\nEND1\n"),
      (std::vector<double>{0, 1, 10, 11}));
}

TEST(Macro, LoopsByTheFirstTwoLettersOfWhile) {
  EXPECT_EQ(
      x_of_macro("#1=0\nWH[#1LT2]DO1\nG0X#1\n#1=#1+1\nEND1\nWH [#1LT3] DO1\nG0X9\n#1=3\nEND1\n"),
      (std::vector<double>{0, 1, 9}));
}

TEST(Macro, JumpsForwardAndBack) {
  EXPECT_EQ(x_of_macro("G0 X1\nGOTO 20\nG0 X2\nN20 G0 X3\n"), (std::vector<double>{1, 3}));
  EXPECT_EQ(x_of_macro("#1=0\nN0010 #1=#1+1\nG0 X#1\nIF [#1 LT 3] GOTO 10\nG0 X9\n"),
            (std::vector<double>{1, 2, 3, 9}));
  EXPECT_EQ(x_of_macro("#3=30\nGOTO #3\nG0 X1\nN30 G0 X2\n"), (std::vector<double>{2}));
}

TEST(Macro, JumpsOutOfALoop) {
  EXPECT_EQ(x_of_macro("#1=0\nWHILE[1EQ1]DO1\n#1=#1+1\nG0X#1\nIF[#1EQ2]GOTO99\nEND1\nN99G0X9\n"),
            (std::vector<double>{1, 2, 9}));
}

TEST(Macro, StaysWithinItsProgram) {
  EXPECT_EQ(x_of_macro("O1\nG0 X0\nM98 P2\nN10 G0 X1\nM30\nO2\nGOTO 10\nG0 X5\nN10 G0 X2\nM99\n"),
            (std::vector<double>{0, 2, 1}));
}

TEST(Macro, DoesWhatThenSays) {
  EXPECT_EQ(x_of_macro("#1=1\nIF [#1 EQ 1] THEN #2=5\nIF [#1 EQ 2] THEN #2=6\nG0 X#2\n"),
            (std::vector<double>{5}));
}

TEST(Macro, GivesItsCallArguments) {
  EXPECT_EQ(
      x_of_macro("#1=7\nG65 P100 A1 Z-3 X5\nG0 X#1\nM30\nO100\nG0 X[#1+#24-#26]\n#1=99\nM99\n"),
      (std::vector<double>{9, 7}));
  EXPECT_EQ(x_of_macro("G0 X0\nG65 P100 L3 A2\nM30\nO100\nG91 X#1\nG90\nM99\n"),
            (std::vector<double>{0, 2, 4, 6}));
}

TEST(Macro, TellsWhatIsVacant) {
  EXPECT_EQ(
      x_of_macro("G65 P1 A0\nM30\nO1\nIF [#1 EQ #0] GOTO 1\nG0 X1\nN1 IF [#2 NE #0] GOTO 2\nG0 "
                 "X2\nN2 M99\n"),
      (std::vector<double>{1, 2}));
  // 0 in a computation, but not equal to 0.
  EXPECT_EQ(x_of_macro("G0 X[#5+1]\nIF [#5 EQ 0] GOTO 1\nG0 X2\nN1 M30\n"),
            (std::vector<double>{1, 2}));
}

TEST(Macro, LeavesOutAWordThatIsVacantAndSaysSo) {
  const auto found = motions("G0 X1 Y1\nG0 X2 Y#7\n");
  EXPECT_EQ(*last_of<Traverse>(found).end[Y], 1.0);
  const auto events = all_of<Event>(found);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].name, "vacant");
  EXPECT_EQ(events[0].text, "Y");
}

}  // namespace
}  // namespace frustum::parser
