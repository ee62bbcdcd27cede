#include "parser/program.hpp"

#include <gtest/gtest.h>

#include <string>

#include "parser/writing/canonical_json.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

std::string canon(std::string_view text) {
  std::string lines;
  for (const Motion& motion : motions(text)) lines += to_json_line(motion) + '\n';
  return lines;
}

std::string with_line_ends(std::string text, const std::string& line_end) {
  std::string changed;
  for (const char c : text) {
    if (c == '\n') {
      changed += line_end;
    } else {
      changed += c;
    }
  }
  return changed;
}

constexpr const char* kPart =
    "%\nO1000 (part)\nN10 G21 G90 G17\nN20 G0 X0 Y0 Z5\n; down\nN30 G1 Z-1 F100\n\nN40 G2 X10 "
    "I5\nM30\n%\n";

TEST(Program, ReadsAllLineEndsAlike) {
  const std::string expected = canon(kPart);
  EXPECT_EQ(canon(with_line_ends(kPart, "\r\n")), expected);
  EXPECT_EQ(canon(with_line_ends(kPart, "\r")), expected);
  EXPECT_EQ(canon(with_line_ends(kPart, "\n\r")), expected);
}

TEST(Program, ReadsMixedLineEndsAndALastLineWithoutOne) {
  EXPECT_EQ(canon("G0 X1\r\nX2\nX3\r\n\nX4"), canon("G0 X1\nX2\nX3\n\nX4\n"));
}

TEST(Program, TakesACarriageReturnWithinALineForABlank) {
  EXPECT_EQ(canon("G0 X1\r\r\nX2 (lost\rmark)\nX3 ; 32 LOC\r FLUTE 60\nX4\rY5\n"),
            canon("G0 X1\nX2 (lost mark)\nX3 ; 32 LOC  FLUTE 60\nX4 Y5\n"));
  // No LF anywhere near the beginning: an old Macintosh.
  const std::string remark = "; " + std::string(70'000, '-');
  EXPECT_EQ(canon(remark + "\rG0 X1\rX2\nX3\r"), canon(remark + "\nG0 X1\nX2\nX3\n"));
}

TEST(Program, SkipsAByteOrderMark) { EXPECT_EQ(canon("\xEF\xBB\xBFG0 X1\n"), canon("G0 X1\n")); }

TEST(Program, ReadsTheSameWithoutBlanksInLowerCaseAndWithTabs) {
  const std::string expected = canon("N5 G1 X1. Y-.5 F100\n");
  EXPECT_EQ(canon("N5G1X1.Y-.5F100\n"), expected);
  EXPECT_EQ(canon("n5 g1 x1. y-.5 f100\n"), expected);
  EXPECT_EQ(canon("N5\tG01\tX1.0\tY-0.5\tF100\t\n"), expected);
}

TEST(Program, RemembersLinesAndEntries) {
  const auto program = parse_program(kPart, "part.nc");
  ASSERT_TRUE(program);
  EXPECT_EQ(program->file, "part.nc");
  const auto blocks = blocks_of(*program);
  ASSERT_EQ(blocks.size(), 9U);
  EXPECT_EQ(blocks[6].line, 8U);
  EXPECT_EQ(blocks[1].program, 1000U);
}

TEST(Program, OfNoTextHasNoBlocks) {
  EXPECT_TRUE(blocks_of(*parse_program("", "part.nc")).empty());
  EXPECT_TRUE(blocks_of(*parse_program("\n\n  \n", "part.nc")).empty());
}

}  // namespace
}  // namespace frustum::parser
