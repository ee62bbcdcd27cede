// Subprograms, repeats, variables and CASE of Sinumerik programs.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<double> x_of_program(std::string_view text, const InterpreterOptions& options = {}) {
  std::vector<double> places;
  for (const Traverse& move : all_of<Traverse>(motions(text, options, Dialect::sinumerik))) {
    places.push_back(*move.end[X]);
  }
  return places;
}
using Places = std::vector<double>;

std::string complaint_of(std::string_view text) {
  const auto lines = complaints(text, {}, Dialect::sinumerik);
  if (lines.empty()) return "none";
  return lines[0].substr(0, lines[0].find(" (hint: "));
}

TEST(SinumerikMainBlocks, MayLackTheirNumber) {
  const auto all =
      motions(":10 G0 X5\n:N20 X6\n: X7\nGOTOF N40\nX8\n:N40 X9\n", {}, Dialect::sinumerik);
  EXPECT_EQ(last_of<Traverse>(all).end[AxisLetter::X], 9.0);
  EXPECT_EQ(all_of<Traverse>(all).size(), 4U);
  ASSERT_EQ(all_of<Event>(all).size(), 1U);
  EXPECT_EQ(all_of<Event>(all).front().grade, EventGrade::assumed);
}

TEST(SinumerikPrograms, GoOnBehindAPercentSignWithoutAName) {
  const auto all = motions("%_N_PART_MPF\n%\nG0 X1\nM30\n%\n", {}, Dialect::sinumerik);
  EXPECT_EQ(last_of<Traverse>(all).end[AxisLetter::X], 1.0);
  EXPECT_EQ(all_of<Event>(all).back().name, "%");
  EXPECT_EQ(all_of<Event>(all).back().grade, EventGrade::assumed);
}

TEST(SinumerikProgram, CallsTheProgramsBehindIt) {
  EXPECT_EQ(x_of_program("%_N_MAIN_MPF\nL10\nG0 X1\nSLOT P2\nM30\n%_N_L10_SPF\nG0 X10\nM17\n"
                         "%_N_SLOT_SPF\nPROC SLOT\nG0 X20\nRET\n"),
            (Places{10, 1, 20, 20}));
  // Without a head before it, PROC is one.
  EXPECT_EQ(x_of_program("slot\nM30\nPROC SLOT\nG0 X2\nRET\n"), (Places{2}));
}

TEST(SinumerikProgram, GivesArgumentsAndKeepsVariablesApart) {
  EXPECT_EQ(x_of_program("DEF REAL WIDTH=7\nSLOT(3,2)\nSLOT(,4)\nSLOT\nG0 X=WIDTH\nM30\n"
                         "PROC SLOT(REAL WIDTH, INT COUNT=5)\nG0 X=WIDTH*COUNT\nWIDTH=99\nRET\n"),
            (Places{6, 0, 0, 7}));
}

TEST(SinumerikProgram, SharesRParameters) {
  EXPECT_EQ(x_of_program("R1=2\nL1\nG0 X=R1\nM30\n%_N_L1_SPF\nR1=R1+5\nM17\n"), (Places{7}));
}

TEST(SinumerikProgram, LabelsBelongToTheirProgram) {
  EXPECT_EQ(
      x_of_program(
          "GOTOF DONE\nG0 X1\nDONE:\nL1\nM30\n%_N_L1_SPF\nGOTOF DONE\nG0 X2\nDONE: G0 X3\nRET\n"),
      (Places{3}));
}

TEST(SinumerikProgram, LabelsStandBeforeStatements) {
  const std::string l1 = "M30\n%_N_L1_SPF\nG0 X9\nM17\n";
  EXPECT_EQ(x_of_program("GOTOF DONE\nG0 X1\nDONE: L1\nG0 X2\n" + l1), (Places{9, 2}));
  EXPECT_EQ(x_of_program("DONE: L1 P2\n" + l1), (Places{9, 9}));
  EXPECT_EQ(x_of_program("R1=3\nGOTOF HERE\nG0 X1\nHERE: IF R1==3\nG0 X2\nELSE\nG0 X3\nENDIF\n"),
            (Places{2}));
  EXPECT_EQ(x_of_program("AGAIN: R1=R1+1\nG0 X=R1\nBACK: IF R1<3 GOTOB AGAIN\nG0 X9\n"),
            (Places{1, 2, 3, 9}));
  EXPECT_EQ(x_of_program("AA: FOR R1=1 TO 2\nG0 X=R1\nENDFOR\nR2=R2+1\nIF R2<2 GOTOB AA\n"),
            (Places{1, 2, 1, 2}));
  EXPECT_EQ(x_of_program("AA: G0 X1\nBB: REPEAT AA P=1\nX5\n"), (Places{1, 1, 5}));
  EXPECT_EQ(x_of_program("%_N_MAIN_MPF\nOUT2: SUB2(4)\nM30\nPROC SUB2(REAL XX)\nG0 X=XX\nRET\n"),
            (Places{4}));
}

TEST(SinumerikProgram, FindsSubprogramsInFiles) {
  const auto folder = std::filesystem::temp_directory_path() / "frustum_sinumerik_program";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "drill.spf") << "PROC DRILL(REAL WHERE)\nG0 X=WHERE\nRET\n";
  std::ofstream(folder / "L7.SPF") << "G0 X7\nM17\n";
  InterpreterOptions options;
  options.search_path = {folder};
  EXPECT_EQ(x_of_program("DRILL(5)\nL7\n", options), (Places{5, 7}));
  std::filesystem::remove_all(folder);
}

TEST(SinumerikProgram, SaveBringsTheModesBack) {
  const auto moves = all_of<Traverse>(
      motions("G0 G90 X10\nL1\nX5\nM30\nPROC L1 SAVE\nG91\nX1\nRET\n", {}, Dialect::sinumerik));
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_DOUBLE_EQ(*moves[1].end[X], 11.0);
  EXPECT_DOUBLE_EQ(*moves[2].end[X], 5.0);
}

TEST(SinumerikProgram, RetEndsTheMainProgram) {
  const auto all = motions("G0 X1\nRET\nG0 X2\n", {}, Dialect::sinumerik);
  EXPECT_EQ(all_of<Traverse>(all).size(), 1U);
  EXPECT_EQ(last_of<Stop>(all).kind, StopKind::program_end);
}

TEST(SinumerikProgram, RepeatsParts) {
  // From the label to the statement, between two labels with the second block, one block.
  EXPECT_EQ(x_of_program("AA: G0 X1\nX2\n\nREPEAT AA P=2\nX9\n"), (Places{1, 2, 1, 2, 1, 2, 9}));
  EXPECT_EQ(x_of_program("G0\nAA: X1\nBB: X2\nX3\nREPEAT AA BB\nX9\n"), (Places{1, 2, 3, 1, 2, 9}));
  EXPECT_EQ(x_of_program("G0\nAA: X1\nX2\nREPEATB AA P=2\nX9\n"), (Places{1, 2, 1, 1, 9}));
  // Up to the ENDLABEL, also of a part that is still to come.
  EXPECT_EQ(x_of_program("G0\nAA: X1\nENDLABEL:\nX2\nREPEAT AA\nX9\n"), (Places{1, 2, 1, 9}));
  EXPECT_EQ(x_of_program("G0\nREPEAT AA\nX9\nAA: X1\nENDLABEL:\nX2\n"), (Places{1, 9, 1, 2}));
}

TEST(SinumerikProgram, ChoosesByCase) {
  const std::string text =
      "CASE R1 OF 1 GOTOF ONE 2 GOTOF TWO DEFAULT GOTOF OTHER\nONE: G0 X1\nM30\nTWO: G0 X2\nM30\n"
      "OTHER: G0 X3\n";
  EXPECT_EQ(x_of_program("R1=1\n" + text), (Places{1}));
  EXPECT_EQ(x_of_program("R1=2\n" + text), (Places{2}));
  EXPECT_EQ(x_of_program("R1=7\n" + text), (Places{3}));
  EXPECT_EQ(x_of_program("CASE R1 OF 5 GOTOF NONE\nG0 X1\n"), (Places{1}));
}

TEST(SinumerikProgram, GotocGoesOnWithoutItsLabel) {
  EXPECT_EQ(x_of_program("GOTOC NOWHERE\nG0 X1\nGOTOC THERE\nG0 X2\nTHERE: G0 X3\n"),
            (Places{1, 3}));
}

TEST(SinumerikProgram, ReadsParameters) {
  EXPECT_EQ(x_of_program("R[2+1]=4\nG0 X=R3\nR0=3\nX=R[R0]+R999\n"), (Places{4, 4}));
  EXPECT_EQ(
      x_of_program("DEF INT WHOLE=2.6\nDEF BOOL YES=TRUE\nG0 X=WHOLE\nWHOLE=1/3\nX=WHOLE+YES\n"),
      (Places{3, 1}));
  EXPECT_EQ(x_of_program("DEF INT II\nG0\nFOR II=1 TO 3\nX=II\nENDFOR\n"), (Places{1, 2, 3}));
  EXPECT_EQ(
      x_of_program("G0 X=7 DIV 2\nX=TRUNC(-1.5)\nX=MINVAL(3,2)+MAXVAL(1,5)\nX=ROUNDUP(1.2)\n"),
      (Places{3, -1, 7, 2}));
}

TEST(SinumerikProgram, ReadsWhatTheControlKnows) {
  EXPECT_EQ(x_of_program(
                "G0 X5 Y3\nX=$P_EP[X]+$AA_IW[Y]\nT4 D1 M6\nX=$P_TOOLNO\nS500 M4\nX=$P_S+$P_SDIR\n"),
            (Places{5, 8, 4, 504}));
}

RC_GTEST_PROP(SinumerikProgramLaws, RepeatEqualsWritingOut, ()) {
  const int count = *rc::gen::inRange(0, 6);
  const auto steps =
      *rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(-50, 50)));
  std::string body;
  for (const int step : steps) body += "G91 G0 X" + std::to_string(step) + "\n";
  std::string whole = "G90 G0 X0\n" + body;
  for (int i = 0; i < count; ++i) whole += body;
  const std::string text =
      "G90 G0 X0\nPART:\n" + body + "REPEAT PART P=" + std::to_string(count) + "\n";
  RC_ASSERT(x_of_program(text) == x_of_program(whole));
}

TEST(SinumerikProgram, TellsMistakes) {
  struct Mistake {
    const char* text;
    const char* complaint;
  };
  const Mistake mistakes[] = {
      {"G0 X1\nNOWHERE\n", "2:1: error: no subprogram NOWHERE"},
      {"N10 L99 P3\n", "1:5: error: no subprogram L99"},
      {"L1 X5\nM30\n%_N_L1_SPF\nRET\n", "1:4: error: words beside a call"},
      {"L1\nM30\n%_N_L1_SPF\nG0 X1\n", "3:2: error: subprogram L1 has no RET"},
      {"L1\nM30\n%_N_L1_SPF\nL1\nRET\n", "4:1: error: more than 32 subprograms within each other"},
      {"AB(1,2)\nM30\nPROC AB(REAL XX)\nRET\n",
       "3:1: error: AB is called with 2 arguments and has 1 parameters"},
      {"PROC AB(REAL X)\nRET\n", "1:14: error: X cannot be defined"},
      {"PROC AB BOGUS\nRET\n", "1:9: error: BOGUS has no meaning after PROC"},
      {"PROC\n", "1:5: error: PROC has no name"},
      {"G0 DEF REAL AA\n", "1:4: error: a statement after other words"},
      {"WIDTH=5\n", "none"},
      {"G0 X=WIDTH\n", "1:4: error: X depends on WIDTH, which only the machine knows"},
      {"FOR WIDTH=1 TO 2\nENDFOR\n", "1:1: error: WIDTH is not defined"},
      {"G0 X=R1000\n", "1:6: error: parameter R1000 does not exist"},
      {"R[1\n", "1:4: error: the index is not closed"},
      {"R1000=1\n", "1:1: error: parameter R1000 does not exist"},
      {"R[0.5]=1\n", "1:1: error: parameter R0.5 is not a whole number"},
      {"G0 X=$AC_TIME\n", "1:4: error: X depends on $AC_TIME, which only the machine knows"},
      {"G0 X=$P_EP\n", "1:11: error: $P_EP without its axis"},
      {"G0 X=$P_EP[X]\n", "1:4: error: X depends on $P_EP[X], which only the machine knows"},
      {"REPEAT AA\n", "1:1: error: there is no part AA to repeat"},
      {"AA: G0 X1\nREPEAT AA P=-0.5\n", "2:1: error: -0.5 is no number of repeats"},
      {"AA: G0 X1\nREPEAT AA BB\n", "2:1: error: there is no part AA to BB to repeat"},
      {"AA: G0 X1\nREPEAT AA BB P=2\nBB: X2\n",
       "2:1: error: more than 32 repeats within each other"},
      {"REPEATB\n", "1:8: error: REPEATB has no label"},
      {"CASE R1\n", "1:8: error: CASE has no OF"},
      {"CASE R1 OF\n", "1:11: error: CASE has no values"},
      {"CASE R1 OF 1 G0\n", "1:14: error: a value of CASE has no jump"},
      {"CASE R1 OF 0 GOTOF NOWHERE\n", "1:1: error: there is no NOWHERE to go to"},
      {"%_N_AB_MPF\nG0 X1\nM30\n%_N_CC_SPF\nRET\n%_N_CC_SPF\nCC\n", "none"},
      {"AA:\nGOTOF CC\nAA:\nBB:\n", "2:1: error: there is no CC to go to"},
      {"G0 X1\nAA:\nGOTOF AA\n", "3:1: error: there is no AA to go to"},
  };
  for (const Mistake& mistake : mistakes) {
    EXPECT_EQ(complaint_of(mistake.text), mistake.complaint) << mistake.text;
  }
}

}  // namespace
}  // namespace frustum::parser
