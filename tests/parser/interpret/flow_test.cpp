// Loops, branches, calls and jumps: what runs, and what is reported of statements that do not fit
// together.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include "parser/writing/canonical_json.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<double> x_of(std::string_view text) {
  std::vector<double> places;
  for (const Traverse& move : all_of<Traverse>(motions(text, {}, Dialect::linuxcnc))) {
    places.push_back(*move.end[X]);
  }
  return places;
}

std::vector<std::string> faults(std::string_view text) {
  return complaints(text, {.max_blocks = 1000}, Dialect::linuxcnc);
}

TEST(Flow, RunsAWhileAsLongAsItsConditionHolds) {
  EXPECT_EQ(x_of("#1=0\no1 while [#1 LT 3]\nG0 X#1\n#1=[#1+1]\no1 endwhile\nG0 X9\n"),
            (std::vector<double>{0, 1, 2, 9}));
  EXPECT_EQ(x_of("o1 while [0]\nG0 X1\no1 endwhile\nG0 X9\n"), (std::vector<double>{9}));
}

TEST(Flow, RunsADoOnceAtLeast) {
  EXPECT_EQ(x_of("o1 do\nG0 X1\no1 while [0]\nG0 X9\n"), (std::vector<double>{1, 9}));
}

TEST(Flow, GoesOnWithADoAtItsCondition) {
  EXPECT_EQ(x_of("#1=0\no1 do\n#1=[#1+1]\no2 if [#1 EQ 2]\no1 continue\no2 endif\nG0 X#1\n"
                 "o1 while [#1 LT 4]\n"),
            (std::vector<double>{1, 3, 4}));
}

TEST(Flow, RepeatsAsOftenAsItSays) {
  EXPECT_EQ(x_of("G0 X0\nG91\no1 repeat [3]\nX1\no1 endrepeat\n"),
            (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(x_of("G0 X0\nG91\no1 repeat [0]\nX1\no1 endrepeat\n"), (std::vector<double>{0}));
  EXPECT_EQ(x_of("G0 X0\nG91\no1 repeat [2]\no2 repeat [2]\nX1\no2 endrepeat\no1 endrepeat\n"),
            (std::vector<double>{0, 1, 2, 3, 4}));
}

TEST(Flow, TakesTheFirstBranchThatHolds) {
  const auto chosen = [](int value) {
    return x_of(
        fmt::format("#1={}\no1 if [#1 EQ 1]\nG0 X1\no1 elseif [#1 EQ 2]\nG0 X2\no1 else\nG0 X3\n"
                    "o1 endif\nG0 X9\n",
                    value));
  };
  EXPECT_EQ(chosen(1), (std::vector<double>{1, 9}));
  EXPECT_EQ(chosen(2), (std::vector<double>{2, 9}));
  EXPECT_EQ(chosen(5), (std::vector<double>{3, 9}));
}

TEST(Flow, LeavesTheLoopItNames) {
  EXPECT_EQ(x_of("o1 while [1]\no2 while [1]\nG0 X1\no1 break\no2 endwhile\no1 endwhile\nG0 X9\n"),
            (std::vector<double>{1, 9}));
}

TEST(Flow, GivesACallItsOwnParameters) {
  EXPECT_EQ(
      x_of(
          "o<pocket> sub\nG0 X#1\n#1=7\n#<mine>=8\n#<_ours>=9\no<pocket> endsub [#1]\n"
          "#1=5\no<pocket> call [1]\nG0 X#1\nG0 X#<_ours>\nG0 X#<_value>\nG0 X[EXISTS[#<mine>]]\n"),
      (std::vector<double>{1, 5, 9, 7, 0}));
}

TEST(Flow, ReturnsFromWithinALoop) {
  EXPECT_EQ(x_of("o1 sub\no2 while [1]\nG0 X1\no1 return [4]\no2 endwhile\no1 endsub\no1 call\n"
                 "G0 X#<_value>\no1 call\n"),
            (std::vector<double>{1, 4, 1}));
}

TEST(Flow, NamesItsLabelsByExpressions) {
  EXPECT_EQ(x_of("o102 sub\nG0 X2\no102 endsub\n#5=100\no[#5+2] call\n"), (std::vector<double>{2}));
}

TEST(Flow, LooksForSubprogramsBesideTheProgram) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "frustum-flow";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "slot.ngc") << "o<slot> sub\nG0 X#1\no<slot> endsub\nM2\n";
  const auto found = motions("o<slot> call [6]\n", {.search_path = {folder}}, Dialect::linuxcnc);
  EXPECT_EQ(*last_of<Traverse>(found).end[X], 6.0);
}

TEST(Flow, MotionsOfASubprogramNameItsFile) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "frustum-flow-file";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "slot.ngc") << "o<slot> sub\nG0 X#1\no<slot> endsub\nM2\n";
  const auto found =
      motions("G0 X1\no<slot> call [6]\nG0 X2\n", {.search_path = {folder}}, Dialect::linuxcnc);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].place.file, nullptr);
  ASSERT_NE(found[1].place.file, nullptr);
  EXPECT_EQ(*found[1].place.file, (folder / "slot.ngc").string());
  EXPECT_EQ(found[1].place.line, 2U);
  EXPECT_EQ(found[2].place.file, nullptr);
  EXPECT_NE(to_json_line(found[1]).find("slot.ngc"), std::string::npos);
  EXPECT_EQ(to_json_line(found[2]).find("file"), std::string::npos);
}

TEST(Flow, WatchSeesEachBlockWithItsFileAndDepth) {
  std::string seen;
  InterpreterOptions options;
  options.watch = [&](const BlockAhead& ahead) {
    EXPECT_EQ(ahead.file, nullptr);
    seen += fmt::format("{}.{} ", ahead.block.line, ahead.calls);
    return ahead.block.line != 6;
  };
  const auto found = motions("o1 sub\nG0 X1\no1 endsub\no1 call\nG0 X2\nG0 X3\nG0 X4\n", options,
                             Dialect::linuxcnc);
  EXPECT_EQ(seen, "1.0 4.0 2.1 3.1 5.0 6.0 ");
  EXPECT_EQ(all_of<Traverse>(found).size(), 2U);
}

TEST(Flow, GoesOnBehindBlocksThatCannotBeRun) {
  std::vector<std::string> told;
  InterpreterOptions options;
  options.go_on = [&](Diagnostic&& problem) {
    told.push_back(fmt::format("{}: {}", problem.line, problem.message));
    return true;
  };
  std::vector<double> x;
  const Program program{"part.nc", Dialect::fanuc,
                        ProgramText("G0 X1 Y1\nG1 X2\nG999\nX(\nG91 G0 X1\nM98 P7\nG0 X1\n")};
  const auto summary = interpret(
      program,
      [&](Motion&& motion) {
        if (const auto* move = std::get_if<Traverse>(&motion.command))
          x.push_back(*move->end[AxisLetter::X]);
      },
      options);
  ASSERT_TRUE(summary);
  ASSERT_EQ(told.size(), 4U);
  EXPECT_EQ(told[0], "2: G1 without a feed rate");
  EXPECT_EQ(told[1].substr(0, 2), "3:");
  EXPECT_EQ(told[2].substr(0, 2), "4:");
  EXPECT_EQ(told[3].substr(0, 2), "6:");
  // The move of line 2 is taken as made, so that what follows has its place.
  EXPECT_EQ(x, (std::vector<double>{1, 3, 4}));
}

struct Mistake {
  const char* text;
  const char* complaint;
};
class FlowFault : public testing::TestWithParam<Mistake> {};

TEST_P(FlowFault, IsToldWithItsPlace) {
  const auto lines = faults(GetParam().text);
  ASSERT_FALSE(lines.empty()) << GetParam().text;
  EXPECT_EQ(lines[0].substr(0, lines[0].find(" (hint:")), GetParam().complaint);
}

INSTANTIATE_TEST_SUITE_P(
    Mistakes, FlowFault,
    testing::Values(
        Mistake{"o1 while [1]\nG0 X1\n", "1:1: error: loop 1 has no end"},
        Mistake{"o1 if [1]\n", "1:1: error: if 1 has no end"},
        Mistake{"G0 X1\n  o1 sub\n", "2:3: error: subprogram 1 has no end"},
        Mistake{"o1 endwhile\n", "1:1: error: there is no loop 1 to which this belongs"},
        Mistake{"o1 if [1]\no2 endif\no1 endif\n",
                "2:1: error: there is no if 2 to which this belongs"},
        Mistake{"o1 else\n", "1:1: error: there is no if 1 to which this belongs"},
        Mistake{"o1 break\n", "1:1: error: there is no loop 1 to which this belongs"},
        Mistake{"o1 if [0]\no1 else\no1 else\no1 endif\n",
                "3:1: error: a part of the if after its else"},
        Mistake{"o1 sub\no1 endsub\no1 sub\no1 endsub\n", "3:1: error: 1 is already on line 1"},
        Mistake{"o1 while [1]\no2 sub\no2 endsub\no1 endwhile\n",
                "2:1: error: subprogram 2 begins within another statement"},
        Mistake{"o1 while\no1 endwhile\n", "1:9: error: while has no expression"},
        Mistake{"o1 endwhile [1]\n", "1:13: error: endwhile takes no expression"},
        Mistake{"o1 whilst [1]\n", "1:4: error: unknown O word whilst"},
        Mistake{"o<a\n", "1:2: error: the name is not closed"},
        Mistake{"o<> sub\n", "1:2: error: the O word has no name"},
        Mistake{"o sub\n", "1:3: error: O has no number or name"},
        Mistake{"o1 if [1] G0 X1\no1 endif\n", "1:11: error: text after an O word"},
        Mistake{"o1 if [1] (open\n", "1:11: error: the comment is not closed"},
        Mistake{"o1 if [1\n", "1:7: error: the bracket is not closed"},
        Mistake{"o9 call\n", "1:1: error: no subprogram 9"},
        Mistake{"o<gone> call\n", "1:1: error: no subprogram gone"},
        Mistake{"o1 return\n", "1:1: error: return outside a subprogram"},
        Mistake{"o1 repeat [1.5]\no1 endrepeat\n", "1:1: error: 1.5 is no number of repeats"},
        Mistake{"o[1.5] call\n", "1:1: error: 1.5 is no number of a block or subprogram"},
        Mistake{"o1 while [1/0]\no1 endwhile\n", "1:12: error: division of 1 by zero"},
        Mistake{"o1 sub\nG0 X[#<gone>]\no1 endsub\no1 call\n",
                "2:6: error: parameter #<gone> has no value"},
        Mistake{"o1 sub\no1 call\no1 endsub\no1 call\n",
                "2:1: error: more than 32 subprograms within each other"},
        Mistake{"o1 while [1]\no1 endwhile\n", "1:1: error: more than 1000 blocks have run again"},
        Mistake{"M72\n", "1:1: error: there are no saved modes"}));

TEST(Flow, TellsTheSyntaxErrorsOfTheRestTogether) {
  const Program program{"part.ngc", Dialect::linuxcnc,
                        ProgramText(std::string("G0 X[\nG0 X1\nG0 Y]\n"))};
  const auto failed = motions_of(program);
  ASSERT_FALSE(failed);
  ASSERT_EQ(failed.error().size(), 2U);
  EXPECT_EQ(failed.error()[1].line, 3);
}

// A file is read through a window; the lines that are across its edges are whole.
TEST(ProgramFile, IsReadThroughAWindow) {
  const auto file = std::filesystem::path(testing::TempDir()) / "frustum-window.ngc";
  std::string text = "o1 sub\nG0 X-1\no1 endsub\n";
  for (int i = 0; i < 150'000; ++i) text += fmt::format("N{} G0 X{}\r\n", i % 10'000, i);
  text += "o1 call\n";  // far after its definition
  ASSERT_GT(text.size(), std::size_t{2} << 20U);
  std::ofstream(file, std::ios::binary) << text;
  const auto program = open_program(file, Dialect::linuxcnc);
  ASSERT_TRUE(program);
  int next = 0;
  const auto summary = interpret(*program, [&](Motion&& motion) {
    const double x = *std::get<Traverse>(motion.command).end[X];
    if (next < 150'000) {
      ASSERT_EQ(x, next);
      ASSERT_EQ(motion.place.line, static_cast<std::uint32_t>(next) + 4U);
    } else {
      ASSERT_EQ(x, -1.0);
    }
    ++next;
  });
  ASSERT_TRUE(summary);
  EXPECT_EQ(next, 150'001);
  std::filesystem::remove(file);
}

TEST(ProgramFile, ThatIsNotThereIsTold) {
  const auto none = open_program("no/such.ngc", Dialect::linuxcnc);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().front().file, "no/such.ngc");
  const auto folder = open_program(std::filesystem::temp_directory_path(), Dialect::linuxcnc);
  ASSERT_FALSE(folder);
  EXPECT_EQ(folder.error().front().hint, "it is a folder");
}

}  // namespace
}  // namespace frustum::parser
