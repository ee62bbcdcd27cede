#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<double> x_of_subprogram(std::string_view text) {
  std::vector<double> positions;
  for (const Traverse& move : all_of<Traverse>(motions(text))) positions.push_back(*move.end[X]);
  return positions;
}

TEST(Subprogram, RunsWhereItIsCalledAndComesBack) {
  EXPECT_EQ(x_of_subprogram("O1\nG0 X1\nM98 P2\nX4\nM30\nO2\nX2\nX3\nM99\n"),
            (std::vector<double>{1, 2, 3, 4}));
}

TEST(Subprogram, RepeatsAsOftenAsLSays) {
  EXPECT_EQ(x_of_subprogram("G0 X0\nM98 P2 L3\nM30\nO2\nG91 X1\nG90\nM99\n"),
            (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(x_of_subprogram("G0 X0\nM98 P2 L0\nM30\nO2\nX1\nM99\n"), (std::vector<double>{0}));
}

TEST(Subprogram, RepeatsByTheUpperDigitsOfP) {
  EXPECT_EQ(x_of_subprogram("G0 X0\nM98 P00031234\nM30\nO1234\nG91 X1\nG90\nM99\n"),
            (std::vector<double>{0, 1, 2, 3}));
}

TEST(Subprogram, MayHaveANumberOfMoreThanFourDigits) {
  EXPECT_EQ(x_of_subprogram("G0 X0\nM98 P31234\nM30\nO31234\nX1\nM99\n"),
            (std::vector<double>{0, 1}));
}

TEST(Subprogram, IsCalledAfterTheMoveOfItsBlock) {
  EXPECT_EQ(x_of_subprogram("G0 X1 M98 P2\nM30\nO2\nX2\nM99\n"), (std::vector<double>{1, 2}));
}

TEST(Subprogram, CallsOthers) {
  EXPECT_EQ(x_of_subprogram("G0 X1\nM98 P2\nX5\nM30\nO2\nX2\nM98 P3\nX4\nM99\nO3\nX3\nM99\n"),
            (std::vector<double>{1, 2, 3, 4, 5}));
}

TEST(Subprogram, NestsThirtyTwoDeep) {
  std::string text = "G0 X0\nM98 P1\nM30\n";
  for (int i = 1; i < 32; ++i) text += fmt::format("O{}\nM98 P{}\nM99\n", i, i + 1);
  EXPECT_TRUE(complaints(text + "O32\nX1\nM99\n").empty());
  text += "O32\nM98 P33\nM99\nO33\nX1\nM99\n";
  ASSERT_EQ(complaints(text).size(), 1U);
}

TEST(Subprogram, MayEndTheProgram) {
  EXPECT_EQ(x_of_subprogram("G0 X1\nM98 P2\nX9\nM30\nO2\nX2\nM30\nM99\n"),
            (std::vector<double>{1, 2}));
}

TEST(Subprogram, LeavesModesAndParametersChanged) {
  EXPECT_EQ(x_of_subprogram("G0 X1\nM98 P2\nX#1\nM30\nO2\n#1=7\nG91\nM99\n"),
            (std::vector<double>{1, 8}));
}

TEST(Program, EndsAtItsSecondTapeMark) {
  EXPECT_EQ(x_of_subprogram("%\nG0 X1\n%\nX2\n"), (std::vector<double>{1}));
  EXPECT_EQ(x_of_subprogram("(part)\n%\nO1\nG0 X1\n%\n"), (std::vector<double>{1}));
}

TEST(Program, MayHaveCommentsBeforeItsNumber) {
  EXPECT_EQ(x_of_subprogram("(part 7)\n\nO1000 (main)\nG0 X1\nM30\n"), (std::vector<double>{1}));
}

TEST(Program, IsStoppedWhenItsRepeatsNeverEnd) {
  std::string text = "G0 X0\nM98 P1 L99999\nM30\n";
  text += "O1\nM98 P2 L99999\nM99\nO2\nM98 P3 L99999\nM99\nO3\nG4 P1\nM99\n";
  const auto lines = complaints(text, {.max_blocks = 1000});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("more than 1000 blocks have run"), std::string::npos);
}

}  // namespace
}  // namespace frustum::parser
