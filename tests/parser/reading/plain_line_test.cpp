// Law: a plain line of Klartext is what the reader of statements would read.
#include "parser/reading/heidenhain/plain_line.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "parser/reading/block_reader.hpp"
#include "tests/parser/random_program.hpp"
#include "tests/parser/same_block.hpp"

namespace frustum::parser {
namespace {

TEST(PlainLineLaws, AreWhatTheReaderOfStatementsReads) {
  constexpr std::array<std::string_view, 34> kTokens{
      "L",   "L ",  "l ",   "X+1",   "Y-2.5", "z.5 ", "A30",  "C-90.", "12 ", "X",   "R0", "R0 ",
      "R05", "RL ", "FMAX", "FMAX ", "F100",  "F",    "F5.5", "M3",    "M13", "M8 ", "M",  " ",
      "\t",  "-",   ".",    ",5",    "IX+1",  "Q1",   "X+Q1", ";",     "\r",  "LN"};
  int plain = 0;
  Block read;  // again and again, as where a program is read
  Block none;
  for (std::uint64_t seed = 1; seed <= 50'000; ++seed) {
    Dice dice(seed);
    std::string text = dice.below(3) == 0 ? "" : dice.below(2) == 0 ? "L " : "7 L ";
    for (std::size_t i = dice.below(6); i > 0; --i) text += kTokens.at(dice.below(kTokens.size()));
    if (!read_plain_line(read, text, 7)) continue;
    ++plain;
    // A tab for the blank after L is no plain line, and the same to the reader of statements.
    std::string slow = text;
    const std::size_t blank = slow.find(' ', slow.find_first_of("lL"));
    slow[blank] = '\t';
    ASSERT_FALSE(read_plain_line(none, slow, 7)) << text;
    const auto statements = reader_of(Dialect::heidenhain)(slow, 7);
    ASSERT_TRUE(statements) << text;
    ASSERT_TRUE(same_block(read, *statements)) << text;
    ASSERT_EQ(read.line, statements->line);
    ASSERT_EQ(read.words.size(), statements->words.size()) << text;
    for (std::size_t i = 0; i < read.words.size(); ++i) {
      ASSERT_EQ(read.words[i].column, statements->words[i].column) << text;
    }
  }
  EXPECT_GE(plain, 2000);
}

TEST(PlainLine, IsMostOfAProgram) {
  Block block;
  for (const char* text : {"12 L X+1.5 Y-2 Z.5 R0 F500 M3", "L X1Y2FMAX", "  L C+90 FMAX M8 "}) {
    EXPECT_TRUE(read_plain_line(block, text, 1)) << text;
  }
  for (const char* text : {"L X+Q1", "LN X+1", "L X+1 RL", "L X+1,5", "L X+1 M128", "L X", "L M13",
                           "L X+1 ;end", "L IX+1", "L X+1 F AUTO"}) {
    EXPECT_FALSE(read_plain_line(block, text, 1)) << text;
  }
}

}  // namespace
}  // namespace frustum::parser
