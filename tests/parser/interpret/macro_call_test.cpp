// G65, G66, G67, M98 and M99: arguments, nesting, where programs go on.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fmt/format.h>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<double> x_of_call(std::string_view text, const InterpreterOptions& options = {}) {
  std::vector<double> places;
  for (const Traverse& move : all_of<Traverse>(motions(text, options)))
    places.push_back(*move.end[X]);
  return places;
}
using Places = std::vector<double>;

TEST(MacroCall, GivesEachLetterItsParameter) {
  // A 1, B 2, C 3, I 4, J 5, K 6, D 7, E 8, F 9, H 11, M 13, Q 17 to Z 26.
  const char* letters = "ABCIJKDEFHMQRSTUVWXYZ";
  const int numbers[] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 13, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};
  for (std::size_t i = 0; i < std::size(numbers); ++i) {
    EXPECT_EQ(
        x_of_call(fmt::format("G65 P1 {}5.5\nM30\nO1\nG0 X#{}\nM99\n", letters[i], numbers[i])),
        (Places{5.5}))
        << letters[i];
  }
}

TEST(MacroCall, CountsRepeatedCentresOn) {
  EXPECT_EQ(
      x_of_call("G65 P1 A1 B2 C3 I4 J5 K6 I7 J8 K9 I10 J11\nM30\nO1\nG0 X#3\nX#6\nX#7\nX#9\nX#11\n"
                "M99\n"),
      (Places{3, 6, 7, 9, 11}));
  // The manual's example: D comes later and counts.
  EXPECT_EQ(x_of_call("G65 A1 B2 I-3 I4 D5 P1000\nM30\nO1000\nG0 X#4\nX#7\nM99\n"),
            (Places{-3, 5}));
  // Ten of each: the last is #33.
  std::string call = "G65 P1";
  for (int i = 1; i <= 10; ++i) call += fmt::format(" I{0} J{0}.1 K{0}.2", i);
  EXPECT_EQ(x_of_call(call + "\nM30\nO1\nG0 X#31\nX#33\nM99\n"), (Places{10, 10.2}));
}

TEST(MacroCall, NestsEachWithItsOwnVariables) {
  EXPECT_EQ(
      x_of_call(
          "#1=1\nG65 P1 A2\nG0 X#1\nM30\nO1\nG65 P2 A3\nG0 X#1\nM99\nO2\nG0 X#1\n#1=99\nM99\n"),
      (Places{3, 2, 1}));
}

TEST(ModalCall, RunsAfterEachBlockThatMoves) {
  EXPECT_EQ(x_of_call("G66 P1 A100\nG0 X1\nM8\nG4 P1\nX2\nG67\nX3\nM30\nO1\nG0 X[#5001+#1]\nM99\n"),
            (Places{1, 101, 2, 102, 3}));
  // Not after G66 itself, and L repeats.
  EXPECT_EQ(x_of_call("G66 P1 L2 A10\nG0 X1\nG67\nM30\nO1\nG0 X[#5001+#1]\nM99\n"),
            (Places{1, 11, 21}));
}

TEST(ModalCall, NestsAsTheManualShows) {
  // After a move the innermost macro runs; its moves run the one before, whose moves run none.
  EXPECT_EQ(x_of_call("G66 P9100\nG0 X1\nG66 P9200\nX2\nG67\nG67\nX3\nM30\n"
                      "O9100\nG0 X50\nM99\nO9200\nG0 X60\nX-70\nM99\n"),
            (Places{1, 50, 2, 60, 50, -70, 50, 3}));
}

TEST(ModalCall, KeepsWhatItsMacroLeavesInTheArguments) {
  EXPECT_EQ(x_of_call("G66 P1 A1\nG0 X0\nG0 X0\nG67\nM30\nO1\n#1=#1*10\nG0 X#1\nM99\n"),
            (Places{0, 10, 0, 100}));
}

TEST(ModalCall, GoesOnInSubprograms) {
  EXPECT_EQ(x_of_call("G66 P1\nM98 P2\nG0 X5\nM30\nO1\nG0 X-1\nM99\nO2\nG0 X2\nG67\nM99\n"),
            (Places{2, -1, 5}));
}

RC_GTEST_PROP(ModalCallLaws, IsACallAfterEachBlock, ()) {
  const auto places = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-99, 99));
  const auto a = *rc::gen::inRange(-99, 99);
  const std::string macro = "M30\nO1\nG91 G0 X#1\nY-#1\nG90\nM99\n";
  std::string modal = fmt::format("G0 X0 Y0\nG66 P1 A{}\n", a), plain = "G0 X0 Y0\n";
  for (const int place : places) {
    modal += fmt::format("G0 X{}\n", place);
    plain += fmt::format("G0 X{}\nG65 P1 A{}\n", place, a);
  }
  RC_ASSERT(x_of_call(modal + "G67\n" + macro) == x_of_call(plain + macro));
}

TEST(Leave, GoesOnAtTheBlockThatPNames) {
  EXPECT_EQ(x_of_call("G0 X1\nM98 P2\nX9\nN50 X5\nM30\nO2\nX2\nM99 P50\n"), (Places{1, 2, 5}));
  // Backwards too, and what is left of the repeats does not run.
  EXPECT_EQ(
      x_of_call(
          "#1=0\nG0 X0\nN10 #1=#1+1\nIF [#1 GT 2] GOTO 20\nM98 P2 L5\nN20 M30\nO2\nX#1\nM99 P10\n"),
      (Places{0, 1, 2}));
}

TEST(Leave, RepeatsTheMainProgramWhileStatementsMayEndIt) {
  EXPECT_EQ(x_of_call("O1\nIF [#100 GE 3] GOTO 99\n#100=#100+1\nG0 X#100\nM99\nN99 M30\n"),
            (Places{1, 2, 3}));
  EXPECT_EQ(x_of_call("G0 X1\nM99 P30\nX2\nN30 X3\nM30\n"), (Places{1, 3}));
  const auto lines = complaints("IF [1 EQ 2] GOTO 9\nG0 X1\nM99\nN9 M30\n", {.max_blocks = 100});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("more than 100 blocks have run"), std::string::npos) << lines[0];
  EXPECT_NE(lines[0].find("M99 in the main program"), std::string::npos) << lines[0];
}

TEST(Program, MayBeginWithAColon) {
  EXPECT_EQ(x_of_call(":1 (main)\nG0 X1\nM98 P2\nM30\n:2\nX2\nM99\n"), (Places{1, 2}));
}

TEST(Program, MayNameTheSwitchOfItsDeletedBlocks) {
  const char* text = "G0 X1\n/2 X2\n/9N5X3\nN6 /1 X4\n/ X5\n/3 IF [1 EQ 1] GOTO 7\nX6\nN7 X7\n";
  EXPECT_EQ(x_of_call(text), (Places{1, 2, 3, 4, 5, 7}));
  EXPECT_EQ(x_of_call(text, {.block_delete = true}), (Places{1, 6, 7}));
}

TEST(Program, MayEndItsBlocksWithASemicolon) {
  const auto found = motions("%;\nO1;\nG0 X1;\nX2 ; beside\nM30;\n%\n");
  EXPECT_EQ(all_of<Event>(found).size(), 1U);
  EXPECT_EQ(all_of<Traverse>(found).size(), 2U);
}

}  // namespace
}  // namespace frustum::parser
