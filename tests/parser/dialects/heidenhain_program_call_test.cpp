// CALL PGM and CYCL DEF 12: programs of their own file, their labels, units, parameters and
// mistakes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

class HeidenhainProgramCall : public testing::Test {
 protected:
  HeidenhainProgramCall() {
    std::filesystem::create_directories(folder_);
    options_.search_path = {folder_};
  }
  ~HeidenhainProgramCall() override { std::filesystem::remove_all(folder_); }
  HeidenhainProgramCall(const HeidenhainProgramCall&) = delete;
  HeidenhainProgramCall& operator=(const HeidenhainProgramCall&) = delete;

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  [[nodiscard]] std::vector<double> x_of(const std::string& text) const {
    std::vector<double> places;
    for (const Traverse& move : all_of<Traverse>(run(text))) places.push_back(*move.end[X]);
    return places;
  }
  [[nodiscard]] std::vector<Motion> run(const std::string& text) const {
    return motions(text, options_, Dialect::heidenhain);
  }
  // "called.h:3:1: error: ..", without the folder and the hint.
  [[nodiscard]] std::string complaint(const std::string& text) const {
    const auto program = parse_program(text, (folder_ / "main.h").string(), Dialect::heidenhain);
    const auto found = motions_of(*program, options_);
    if (found) return {};
    const std::string line = to_string(found.error().front()).substr(folder_.string().size() + 1);
    return line.substr(0, line.find(" (hint: "));
  }

  std::filesystem::path folder_ = std::filesystem::temp_directory_path() /
                                  testing::UnitTest::GetInstance()->current_test_info()->name();
  InterpreterOptions options_{};
};
using Places = std::vector<double>;

TEST_F(HeidenhainProgramCall, RunsTheFileAndComesBack) {
  write("slot.h", "0 BEGIN PGM SLOT MM\n1 L IX+1 FMAX\n2 END PGM SLOT MM\n");
  write("HOLE.H", "L X+7 FMAX\nEND PGM HOLE MM\n");
  const std::string text =
      "BEGIN PGM A MM\nL X+0 FMAX\nCALL PGM SLOT\nCALL PGM TNC:\\WORK\\SLOT.H ; again\n"
      "CALL PGM \"HOLE.h\"\nL X+9 FMAX\nEND PGM A MM\n";
  EXPECT_EQ(x_of(text), (Places{0, 1, 2, 7, 9}));
  const auto all = run(text);
  EXPECT_EQ(all_of<Stop>(all).size(), 1U);
  for (const Motion& motion : all) {
    if (const auto* move = std::get_if<Traverse>(&motion.command); move && *move->end[X] == 7.0) {
      ASSERT_TRUE(motion.place.file);
      EXPECT_TRUE(motion.place.file->ends_with("HOLE.H"));
      EXPECT_EQ(motion.place.line, 1U);
    }
  }
}

TEST_F(HeidenhainProgramCall, LabelsBelongToTheirFile) {
  write("b.h",
        "CALL LBL 1\nLBL 2\nL IX+10 FMAX\nCALL LBL 2 REP 1\nEND PGM B MM\n"
        "LBL 1\nL IX+100 FMAX\nLBL 0\n");
  EXPECT_EQ(x_of("L X+0 FMAX\nCALL LBL 1\nL M30\nLBL 1\nCALL PGM B\nL IX+1 FMAX\nLBL 0\n"),
            (Places{0, 100, 110, 120, 121}));
  write("c.h", "CALL LBL 5\nEND PGM C MM\n");
  EXPECT_EQ(complaint("CALL PGM C\nL M30\nLBL 5\nLBL 0\n"), "c.h:1:1: error: no subprogram 5");
}

TEST_F(HeidenhainProgramCall, SharesQAndKeepsQlOfEachFile) {
  write("b.h", "Q1 = Q1 + 1\nQL1 = 50\nL X+QL1 FMAX\nEND PGM B MM\n");
  EXPECT_EQ(x_of("Q1 = 3\nQL1 = 5\nCALL PGM B\nL X+Q1 FMAX\nL X+QL1 FMAX\nCALL LBL 1\n"
                 "L X+QL1 FMAX M30\nLBL 1\nQL1 = QL1 + 1\nLBL 0\n"),
            (Places{50, 4, 5, 6}));
}

TEST_F(HeidenhainProgramCall, TheUnitIsThatOfTheFile) {
  write("b.h", "BEGIN PGM B INCH\nL X+1 FMAX\nEND PGM B INCH\n");
  EXPECT_EQ(x_of("BEGIN PGM A MM\nCALL PGM B\nL X+1 FMAX\nEND PGM A MM\n"), (Places{25.4, 1}));
}

TEST_F(HeidenhainProgramCall, IsMadeByACycleAtEachCall) {
  write("b.h", "L IX+1 FMAX\nEND PGM B MM\n");
  EXPECT_EQ(x_of("CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM TNC:\\B.H\nL X+10 FMAX M99\n"
                 "L X+20 FMAX\nCYCL CALL\nL X+30 FMAX\n"),
            (Places{10, 11, 20, 21, 30}));
}

TEST_F(HeidenhainProgramCall, MistakesNameTheFile) {
  write("syntax.h", "L X+1 FMAX\nL X+? FMAX\nEND PGM SYNTAX MM\n");
  EXPECT_EQ(complaint("CALL PGM SYNTAX\n"), "syntax.h:2:3: error: X has no number");
  write("words.h", "L X+1 M96\nEND PGM WORDS MM\n");
  EXPECT_EQ(complaint("CALL PGM WORDS\n"), "words.h:1:7: error: M96 is not simulated");
  write("open.h", "L X+1 FMAX\n");
  EXPECT_EQ(complaint("CALL PGM OPEN\n"), "open.h:1:1: error: subprogram OPEN has no END PGM");
  write("label.h", "L X+1 FMAX\nCALL LBL 1\nLBL 1\nEND PGM LABEL MM\n");
  EXPECT_EQ(complaint("CALL PGM LABEL\n"), "label.h:3:1: error: subprogram 1 has no LBL 0");
  write("ends.h", "L X+1 FMAX M30\nEND PGM ENDS MM\n");
  EXPECT_EQ(complaint("CALL PGM ENDS\n"), "ends.h:1:12: error: M30 in a program that is called");
  write("loop.h", "CALL PGM LOOP\nEND PGM LOOP MM\n");
  EXPECT_EQ(complaint("CALL PGM LOOP\n"),
            "loop.h:1:10: error: more than 32 subprograms within each other");
  EXPECT_EQ(complaint("L X+1 FMAX\nCALL PGM " + std::string(5000, 'A') + "\n").substr(0, 38),
            "main.h:2:10: error: there is no progra");
}

}  // namespace
}  // namespace frustum::parser
