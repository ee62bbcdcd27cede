// What the text of a program says of itself, in the ways of each dialect.
#include <gtest/gtest.h>

#include <fstream>

#include "lint/subprogram_text.hpp"
#include "tests/lint/checking.hpp"

namespace frustum::lint {
namespace {

using parser::Dialect;

TEST(ProgramStructure, KnowsTheSubprogramsOfLinuxCnc) {
  const std::string program =
      "o1 sub\nG0 X1\no1 endsub\no2 sub\nG0 X2\no2 endsub\nG0 Y1\no1 call\nM2\n";
  EXPECT_EQ(ids(checked(program, {}, Dialect::linuxcnc)), "4:unused-subprogram ");
}

TEST(ProgramStructure, SaysNothingWhereACallIsComputed) {
  const std::string program = "G0 Y1\no2 sub\nG0 X2\no2 endsub\n#1=2\no[#1] call\nM2\n";
  EXPECT_EQ(ids(checked(program, {}, Dialect::linuxcnc)), "");
}

TEST(ProgramStructure, KnowsTheLabelsOfKlartext) {
  const std::string program =
      "BEGIN PGM P MM\nL X+1 R0 FMAX\nCALL LBL 1\nM30\nLBL 1\nL X+2 R0 FMAX\nLBL 0\nLBL 2\n"
      "L X+3 R0 FMAX\nLBL 0\nEND PGM P MM\n";
  EXPECT_EQ(ids(checked(program, {}, Dialect::heidenhain)), "8:unused-label ");
}

TEST(ProgramStructure, KnowsTheJumpsAndRepeatsOfSinumerik) {
  const std::string program =
      "CASE R1 OF 0 GOTOF ZERO DEFAULT GOTOF OTHER\nZERO: G0 X1\nOTHER: G0 X2\nPART: G0 X3\n"
      "ENDLABEL: G0 X4\nREPEAT PART\nSLOT\nM30\n%_N_SLOT_SPF\nG0 X5\nRET\n";
  EXPECT_EQ(ids(checked(program, {}, Dialect::sinumerik)), "");
}

TEST(ProgramStructure, RepeatsInTheNumberOfACallAreNotASubprogram) {
  EXPECT_EQ(ids(checked("G0 X1\nM98 P30007\nM30\nO7\nG0 X2\nM99\n")), "");
}

TEST(ProgramStructure, ABlockThatIsJumpedToBehindTheEndIsReached) {
  EXPECT_EQ(ids(checked("G0 X1\nIF [1 EQ 1] GOTO 9\nM30\nN9 G0 X2\nM30\n")), "");
  EXPECT_EQ(ids(checked("G0 X1\nIF [1 EQ 1] GOTO 9\nM30\nG0 X3\nN9 G0 X2\nM30\n")),
            "4:unreachable-code ");
}

TEST(ProgramStructure, AConditionalOrDeletableEndEndsNothing) {
  EXPECT_EQ(ids(checked("G0 X1\n/M30\nG0 X3\nM30\n", {.run = {.block_delete = true}})), "");
}

TEST(ProgramStructure, M99OfKlartextCallsACycle) {
  const CheckReport report =
      checked("BEGIN PGM P MM\nL X+1 R0 FMAX M99\nL X+2 R0 FMAX\nM30\nEND PGM P MM\n", {},
              Dialect::heidenhain);
  EXPECT_TRUE(of(report, "unreachable-code").empty()) << ids(report);
}

TEST(ProgramStructure, M99WithPGoesOnAtItsBlock) {
  const std::string program = "#1=0\nN20 G0 X1\n#1=#1+1\nIF [#1 GT 2] GOTO 30\nM99 P20\n";
  EXPECT_EQ(ids(checked(program + "N30 G0 X2\nM30\n")), "");
  EXPECT_EQ(ids(checked("G0 X1\nM99 P20\nN20 G0 X2\nM30\n")), "");
}

TEST(ProgramStructure, NothingNeedsToBeABlockBehindTheEnd) {
  const std::pair<Dialect, const char*> programs[] = {
      {Dialect::fanuc, "%\nO1\nG0 X1\nM30\n%\nmade by = hand (\n"},
      {Dialect::linuxcnc, "%\nG0 X1\nM2\n%\nmade by = hand (\n"},
      {Dialect::linuxcnc, "G0 X1\nM2\nmade by = hand (\n"},
      {Dialect::heidenhain, "BEGIN PGM P MM\nL X+1 R0 FMAX\nM30\nEND PGM P MM\nmade by = hand (\n"},
  };
  for (const auto& [dialect, text] : programs) {
    EXPECT_EQ(ids(checked(text, {}, dialect)), "") << text;
  }
  // A subprogram behind it is read, and so is what follows an end that may not come.
  EXPECT_FALSE(of(checked("%\nO1\nG0 X1\nM30\nO7\nG0 X(\nM99\n"), "program-error").empty());
  EXPECT_FALSE(of(checked("o1 if [#1 GT 1]\nM2\no1 endif\nG0 X(\nM2\n", {}, Dialect::linuxcnc),
                  "program-error")
                   .empty());
}

TEST(ProgramStructure, KnowsASubprogramByItsText) {
  const auto is = [](const char* text, Dialect dialect, const char* file = "part.nc") {
    return is_subprogram({file, dialect, parser::ProgramText(std::string(text)), nullptr});
  };
  EXPECT_TRUE(is("O7\nG1 X5\nM99\n%\n", Dialect::fanuc));
  EXPECT_FALSE(is("O1\nM98 P7\nM30\nO7\nG1 X5\nM99\n", Dialect::fanuc));
  EXPECT_FALSE(is("G0 X1\nM30\n", Dialect::fanuc));
  EXPECT_TRUE(is("G1 X5\nM17\n", Dialect::sinumerik));
  EXPECT_TRUE(is("G1 X5\nRET\n", Dialect::sinumerik));
  EXPECT_TRUE(is("PROC SLOT(REAL WIDTH)\nG1 X5\nM30\n", Dialect::sinumerik));
  EXPECT_TRUE(is("G1 X5\n", Dialect::sinumerik, "SLOT.SPF"));
  EXPECT_TRUE(is("o<slot> sub\nG1 X5\no<slot> endsub\nM2\n", Dialect::linuxcnc));
  EXPECT_FALSE(is("o1 sub\nG1 X5\no1 endsub\no1 call\nM2\n", Dialect::linuxcnc));
  EXPECT_FALSE(is("BEGIN PGM P MM\nL X+1 FMAX M99\nEND PGM P MM\n", Dialect::heidenhain, "p.h"));
}

TEST(ProgramStructure, FindsFaultsInSubprogramsOfOtherFilesThere) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "frustum-lint";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "slot.ngc") << "o<slot> sub\nG0 X0\nG1 X#1\no<slot> endsub\nM2\n";
  const auto report =
      checked("o<slot> call [6]\nM2\n", {.run = {.search_path = {folder}}}, Dialect::linuxcnc);
  const auto found = of(report, "feed-missing");
  ASSERT_EQ(found.size(), 1U) << ids(report);
  EXPECT_EQ(found[0].file, (folder / "slot.ngc").string());
  EXPECT_EQ(found[0].line, 3U);
}

}  // namespace
}  // namespace frustum::lint
