#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

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

// M97 of Haas; without P it is a word of the builder.
TEST(Subprogram, MayBeBlocksOfTheSameProgram) {
  EXPECT_EQ(x_of_subprogram("G0 X1\nM97 P50 L2\nX9\nM30\nN50 G91 X1\nG90\nM99\n"),
            (std::vector<double>{1, 2, 3, 9}));
  EXPECT_EQ(x_of_subprogram("G0 X1\nM97\nX9\nM30\nN50 X5\nM99\n"), (std::vector<double>{1, 9}));
}

class FolderOfPrograms : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("frustum_programs_{}", std::random_device{}());
    std::filesystem::create_directories(folder_);
    options_.search_path = {folder_};
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const std::string& name, std::string_view text) const {
    std::ofstream(folder_ / name) << text;
  }

  std::filesystem::path folder_{};
  InterpreterOptions options_{};
};

TEST_F(FolderOfPrograms, AreFoundByTheirNumbers) {
  write("slot.nc", "%\n\n(SLOT)\nO77 (SLOT)\nG0 X5\nM99\n%\n");
  write("other.nc", "O78\nG0 X6\nM99\n");
  write("notes.md", "O77\n");
  const auto all = motions("M98 P77\nM30\n", options_);
  EXPECT_EQ(last_of<Traverse>(all).end[AxisLetter::X], 5.0);
  const auto events = all_of<Event>(all);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].name, "O77");
  EXPECT_EQ(events[0].grade, EventGrade::assumed);
  EXPECT_EQ(complaint_ids("M98 P79\nM30\n", options_),
            std::vector<std::string>{"missing-subprogram"});
}

// "main line/line", with a + where the line is of another file.
std::vector<std::string> origins(const std::vector<Motion>& motions) {
  std::vector<std::string> places;
  for (const Motion& motion : motions) {
    if (!std::holds_alternative<LinearFeed>(motion.command)) continue;
    const SourcePlace& place = motion.place;
    places.push_back(fmt::format("{}/{}{}", place.main_line, place.line, place.file ? "+" : ""));
  }
  return places;
}

TEST_F(FolderOfPrograms, MotionsKnowTheLineOfTheMainProgramThatLedToThem) {
  write("O77.nc", "O77\nG1 X5 F100\nM98 P78\nX6\nM99\n");
  write("O78.nc", "O78\nG1 X7 F100\nM99\n");
  EXPECT_EQ(origins(motions("G1 X1 F100\nM98 P77\nX2\nM98 P9\nX3\nM30\nO9\nX4\nM99\n", options_)),
            (std::vector<std::string>{"1/1", "2/2+", "2/2+", "2/4+", "3/3", "4/8", "5/5"}));
}

// A compensated move waits for the next one, and keeps the place where it was read.
TEST_F(FolderOfPrograms, AMoveThatWaitsKeepsTheLineOfItsCall) {
  write("O77.nc", "O77\nX5 Y5\nY9\nM99\n");
  options_.contours_without_diameter = true;
  EXPECT_EQ(origins(motions("G0 X0 Y0\nG1 G41 D1 X5 F100\nM98 P77\nY20\nG40 X0\nM30\n", options_)),
            (std::vector<std::string>{"2/2", "3/2+", "3/3+", "4/4", "5/5"}));
}

TEST_F(FolderOfPrograms, MustNotShareANumber) {
  write("a.nc", "O77\nM99\n");
  write("b.nc", "O0077\nM99\n");
  const auto found = complaints("M98 P77\nM30\n", options_);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NE(found[0].find("a.nc and b.nc both begin with O77"), std::string::npos) << found[0];
  write("O77.nc", "O77\nG0 X1\nM99\n");
  EXPECT_TRUE(complaints("M98 P77\nM30\n", options_).empty());
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
