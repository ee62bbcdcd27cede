#include "parser/reading/rs274/grammar.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "parser/program.hpp"
#include "parser/writing/block_text.hpp"

namespace frustum::parser {
namespace {

Block block_of(std::string_view text) {
  auto block = parse_block(text, 1);
  if (block) return *std::move(block);
  ADD_FAILURE() << text << ": " << to_string(block.error().front());
  return {};
}

std::string canonical(std::string_view text) {
  const std::array blocks{block_of(text)};
  std::string line = to_text(blocks, Dialect::linuxcnc);
  line.pop_back();
  return line;
}

TEST(Grammar, NeedsNoBlanks) {
  EXPECT_EQ(canonical("G1X1.Y-.5F100"), "G1 X1. Y-0.5 F100");
  EXPECT_EQ(canonical("N10G01X[1+2]YSIN[30](cut)#1=2"), "N10 G1 X[1+2] YSIN[30] #1=2 (cut)");
}

TEST(Grammar, AllowsBlanksAnywhereBetweenTokens) {
  EXPECT_EQ(canonical(" \t G 1\tX  - 5 Y [ 1 + 2 ] Z SIN [ 3 ] # 1 = # < a > \r"),
            "G1 X-5 Y[1+2] ZSIN[3] #1=#<a>");
}

TEST(Grammar, TakesLowerCase) {
  EXPECT_EQ(canonical("n5 g1x1yatan[1]/[2]"), "N5 G1 X1 YATAN[1]/[2]");
}

TEST(Grammar, ReadsBlockNumbersUpToEightDigits) {
  EXPECT_EQ(block_of("N12345678 G1").number, 12345678U);
  EXPECT_EQ(block_of("N00000010").number, 10U);
}

TEST(Grammar, ReadsBlockDeleteBeforeAndBehindTheNumber) {
  EXPECT_TRUE(block_of("/N10 G1").deletable);
  EXPECT_TRUE(block_of("N10 / G1").deletable);
  EXPECT_TRUE(block_of("/").deletable);
  EXPECT_FALSE(block_of("N10 G1").deletable);
}

TEST(Grammar, ReadsProgramNumbersWithTheirComment) {
  const Block block = block_of("  O1234 (CONE)");
  EXPECT_EQ(block.program, 1234U);
  EXPECT_EQ(block.program_column, 3U);
  EXPECT_EQ(block.comments.at(0).text, "CONE");
}

TEST(Grammar, KeepsCommentsAsWritten) {
  const Block block = block_of("G1 ( a b ) X1 (MSG, go) ; to (the) end; ");
  ASSERT_EQ(block.comments.size(), 3U);
  EXPECT_EQ(block.comments[0].text, " a b ");
  EXPECT_EQ(block.comments[1].text, "MSG, go");
  EXPECT_EQ(block.comments[2].text, " to (the) end; ");
  EXPECT_EQ(block.comments[2].column, 25U);
  EXPECT_EQ(block_of("()").comments.at(0).text, "");
}

TEST(Grammar, TurnsLatin1CommentsIntoUtf8AndLeavesUtf8Alone) {
  EXPECT_EQ(block_of("(Fr\xE4ser)").comments.at(0).text, "Fr\xC3\xA4ser");
  EXPECT_EQ(block_of("(Fr\xC3\xA4ser)").comments.at(0).text, "Fr\xC3\xA4ser");
  // Overlong and surrogate encodings are not UTF-8, so they are Latin-1.
  EXPECT_EQ(block_of("(\xC0\xAF)").comments.at(0).text, "\xC3\x80\xC2\xAF");
  EXPECT_EQ(block_of("(\xED\xA0\x80)").comments.at(0).text, "\xC3\xAD\xC2\xA0\xC2\x80");
}

TEST(Grammar, NotesColumnsInBytesFromOne) {
  const Block block = block_of("N5 G1(\xC3\xA4)X5 #1=3");
  EXPECT_EQ(block.words.at(0).column, 4U);
  EXPECT_EQ(block.words.at(1).column, 10U);
  EXPECT_EQ(block.assignments.at(0).column, 13U);
}

TEST(Grammar, KeepsPlainNumbersOutOfTheExpressions) {
  const Block block = block_of("X1 Y-2.5 Z+3. I-0");
  EXPECT_TRUE(block.steps.empty());
  EXPECT_EQ(block.words.at(1).number, -2.5);
  EXPECT_TRUE(block.words.at(1).decimal_point);
  EXPECT_FALSE(block.words.at(0).decimal_point);
  EXPECT_FALSE(std::signbit(block.words.at(3).number));
}

TEST(Grammar, RoundsNumbersCorrectly) {
  EXPECT_EQ(block_of("X0.1").words.at(0).number, 0.1);
  EXPECT_EQ(block_of("X179769313486231570.0000000000001").words.at(0).number, 179769313486231570.0);
  EXPECT_EQ(block_of("X0.3000000000000000166").words.at(0).number, 0.3);
  EXPECT_EQ(block_of("X0." + std::string(400, '0') + "1").words.at(0).number, 0.0);
}

TEST(Grammar, TakesATapeMarkWithAComment) {
  EXPECT_TRUE(block_of("%").tape_mark);
  EXPECT_TRUE(block_of(" % (end)").tape_mark);
}

TEST(Grammar, FindsABlankLineEmpty) {
  EXPECT_TRUE(block_of("").empty());
  EXPECT_TRUE(block_of(" \t\r").empty());
}

}  // namespace
}  // namespace frustum::parser
