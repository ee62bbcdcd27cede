// Every file of data/bad begins with the complaints it must cause, one a line, with their ids:
// "; [arc-radius] 3:5: error: ...".
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(FRUSTUM_SOURCE_DIR) / "tests" / "parser" / "data" / "bad";

std::vector<std::string> bad_programs() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kFolder)) names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

// part.ngc is read as LinuxCNC's, part.nc as Fanuc's.
Dialect dialect_of_bad(const std::string& name) {
  return fs::exists(kFolder / (name + ".ngc")) ? Dialect::linuxcnc : Dialect::fanuc;
}

std::string text_of(const std::string& name) {
  const bool linuxcnc = dialect_of_bad(name) == Dialect::linuxcnc;
  std::ifstream file(kFolder / (name + (linuxcnc ? ".ngc" : ".nc")), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> expected_in(const std::string& text) {
  std::vector<std::string> expected;
  std::size_t begin = 0;
  while (text.compare(begin, 2, "; ") == 0) {
    const std::size_t end = text.find('\n', begin);
    expected.push_back(text.substr(begin + 2, end - begin - 2));
    begin = end + 1;
  }
  return expected;
}

// As the file says them: "[arc-radius] 3:5: error: ...".
std::vector<std::string> identified_complaints(const std::string& text, Dialect dialect) {
  std::vector<std::string> lines = complaints(text, {}, dialect);
  const std::vector<std::string> ids = complaint_ids(text, {}, dialect);
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = "[" + ids.at(i) + "] " + lines[i];
  return lines;
}

class BadProgram : public testing::TestWithParam<std::string> {};

TEST_P(BadProgram, SaysWhereWhatAndTheRemedy) {
  const std::string text = text_of(GetParam());
  const auto expected = expected_in(text);
  ASSERT_FALSE(expected.empty()) << "the file does not begin with its complaints";
  EXPECT_EQ(identified_complaints(text, dialect_of_bad(GetParam())), expected);
  for (const std::string& line : expected) {
    EXPECT_NE(line.find(" (hint: "), std::string::npos) << line;
    EXPECT_FALSE(line.starts_with("[input] ")) << line;
  }
}

INSTANTIATE_TEST_SUITE_P(Corpus, BadProgram, testing::ValuesIn(bad_programs()),
                         [](const auto& name) { return name.param; });

TEST(BadPrograms, AreManyEnoughToCoverTheWordings) { EXPECT_GE(bad_programs().size(), 150U); }

// Complaint 19: a dialect's unknown word is an error with line and word, never skipped.
TEST(Complaint19, UnknownWordsAreErrorsWithLineAndWord) {
  for (const std::string word : {"G77", "G188", "G100", "E3", "V2", "W1"}) {
    const auto lines = complaints("G0 X0\n\nN30 G1 Y5 F100 " + word + "\n");
    ASSERT_EQ(lines.size(), 1U) << word;
    EXPECT_TRUE(lines.front().starts_with("3:16: error: unknown word " + word + " (hint: "))
        << lines.front();
  }
}

TEST(Complaint19, KnownWordsThatAreNotSimulatedBecomeEvents) {
  const auto events = all_of<Event>(motions("G61\nG64 P0.01 Q0.02\nG5.1 Q1\nG8 P1\nM7\nM10\n"));
  std::vector<std::string> seen;
  seen.reserve(events.size());
  for (const Event& event : events) seen.push_back(event.name + "|" + event.text);
  EXPECT_EQ(seen, (std::vector<std::string>{"G61|", "G64|P0.01 Q0.02", "G5.1|Q1", "G8|P1", "M7|",
                                            "M10|"}));
}

TEST(BadPrograms, KeepTheMotionsBeforeTheError) {
  const auto program = parse_program("G21 G0 X1\nX2\nX3 Q1\nX4\n", "part.nc");
  ASSERT_TRUE(program);
  int count = 0;
  const auto summary = interpret(*program, [&count](Motion&&) { ++count; });
  EXPECT_FALSE(summary);
  EXPECT_EQ(count, 2);
}

TEST(BadPrograms, NameBytesThatCannotBePrinted) {
  EXPECT_EQ(complaints("G0 X5 \x1A\n").at(0).substr(0, 33), "1:7: error: unexpected byte 0x1A ");
  EXPECT_EQ(complaints("G0 X5 \xE4\n").at(0).substr(0, 33), "1:7: error: unexpected byte 0xE4 ");
}

TEST(BadPrograms, StopAfterAHundredSyntaxErrors) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "this is prose\n";
  const auto lines = complaints(text);
  ASSERT_EQ(lines.size(), kMaxSyntaxErrors + 1);
  EXPECT_NE(lines.back().find("is this an NC program?"), std::string::npos);
}

}  // namespace
}  // namespace frustum::parser
