// Law: a plain block is what the grammar would read.
#include "parser/reading/rs274/plain_block.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "parser/reading/rs274/grammar.hpp"
#include "tests/parser/random_program.hpp"
#include "tests/parser/same_block.hpp"

namespace frustum::parser {
namespace {

TEST(PlainBlockLaws, AreWhatTheGrammarReads) {
  constexpr std::array<std::string_view, 26> kTokens{
      "G1", "x",  "X",  "Y-2.5", "z+.5", "A 30", "C-90.", "N5", "n0010", "/",  " ",  "\t",  ".",
      "-",  "0.", "12", "F100",  "M3",   "B-0",  "e5",    "O1", "(c)",   "#1", "\r", "1e5", "%"};
  int plain = 0;
  Block read;  // again and again, as where a program is read
  for (std::uint64_t seed = 1; seed <= 50'000; ++seed) {
    Dice dice(seed);
    std::string text;
    for (std::size_t i = dice.below(7); i > 0; --i) text += kTokens.at(dice.below(kTokens.size()));
    if (!read_plain_block(read, text, 7)) continue;
    ++plain;
    const auto grammars = parse_block(text, 7);
    ASSERT_TRUE(grammars) << text;
    ASSERT_TRUE(same_block(read, *grammars)) << text;
    ASSERT_EQ(read.line, grammars->line);
    for (std::size_t i = 0; i < read.words.size(); ++i) {
      ASSERT_EQ(read.words[i].column, grammars->words[i].column) << text;
    }
  }
  EXPECT_GE(plain, 5000);
}

TEST(PlainBlock, IsMostOfAProgram) {
  Block block;
  for (const char* text : {"N10 G1 X1.5 Y-2 Z.5 A-30. C90 F500", "X1Y2", "/N5G0", "", "g1 x 5"}) {
    EXPECT_TRUE(read_plain_block(block, text, 1)) << text;
  }
  for (const char* text : {"X#1", "G1 (c)", "O100", "N10 N20", "X[1]", "%", "X", "X1.2.3"}) {
    EXPECT_FALSE(read_plain_block(block, text, 1)) << text;
  }
}

}  // namespace
}  // namespace frustum::parser
