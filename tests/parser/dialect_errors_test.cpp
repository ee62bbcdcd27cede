// What each dialect refuses, and how: place, message and remedy.
#include <gtest/gtest.h>

#include <span>
#include <string>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

struct Mistake {
  const char* text;
  const char* complaint;  // "line:column: error: message", without the hint
};

constexpr Mistake kLinuxcnc[] = {
    {"G0 X0\nG43.4 H1\n", "2:1: error: G43.4 is not simulated"},
    {"M430\n", "1:1: error: M430 is not simulated"},
    {"M428\nG0 X1 Y2 Z3\n",
     "2:1: error: the tool-tip control is on, but no tool length is in force"},
    {"G43 H0\n", "1:5: error: H0 is out of range"},
    {"G68.2 X0 Y0 Z0\n", "1:1: error: unknown word G68.2"},
    {"G53.1\n", "1:1: error: unknown word G53.1"},
    {"G4 X1\n", "1:4: error: X1 has no meaning in this block"},
    {"G4\n", "1:1: error: G4 without a time"},
    {"G0 X1 I1\n", "1:7: error: I1 has no meaning in this block"},
    {"G10 L2 P1 X0\n", "1:1: error: G10 is not simulated"},
    {"G5 X1\n", "1:1: error: G5 is not simulated"},
    {"G81 Z-1 R2\n", "1:1: error: the cycle starts at an unknown Z: Z has not been programmed yet"},
    {"G92 X0\n", "1:5: error: G92 says where X is, but X has not been programmed yet"},
    {"O100 sub\n", "1:1: error: subprogram 100 has no end"},
    {"G28.1\n", "1:1: error: G28.1 is not simulated"},
    {"G41 D1\n", "1:1: error: G41 is not simulated"},
    {"G0 A1 E5\n", "1:7: error: E5 has no meaning in this block"},
    {"G52\n", "1:1: error: G52 names no axis"},
    {"G1 X1\n", "1:1: error: G1 without a feed rate"},
    {"G51\n", "1:1: error: unknown word G51"},
    {"G0 XATAN[1]\n", "1:12: error: ATAN needs two values"},
    {"G0 XPOW[2,3]\n", "1:4: error: X has no number"},
};

constexpr Mistake kSinumerik[] = {
    {"G1 X=R5 F100\n", "1:6: error: parameter R5 has no value"},
    {"G0 X1 foo\n", "1:7: error: unknown word FOO"},
    {"TRANS X5\n", "1:1: error: TRANS is not simulated"},
    {"IF\n", "1:3: error: IF has no condition"},
    {"IF R1=1\nENDIF\n", "1:7: error: unexpected '1'"},
    {"R1=0\nIF R1==1\n", "2:1: error: if has no end"},
    {"R1=0\nWHILE R1<1\nENDFOR\nELSE\n", "4:1: error: there is no if to which this belongs"},
    {"FOR X=1 TO 3\nENDFOR\n", "1:5: error: FOR has no R parameter to count"},
    {"FOR R1=1\nENDFOR\n", "1:9: error: FOR has no TO"},
    {"GOTOF\n", "1:6: error: GOTOF has no label"},
    {"GOTOF NOWHERE\n", "1:1: error: there is no NOWHERE to go to"},
    {"BACK:\nGOTOF BACK\n", "2:1: error: there is no BACK to go to"},
    {"REPEAT PART1 P=3\n", "1:1: error: REPEAT of labelled blocks is not simulated"},
    {"G0 X0 GOTOF NAME\n", "1:7: error: a statement behind other words"},
    {"LOOP R1\nENDLOOP\n", "1:6: error: unexpected 'R'"},
    {"GOTOF END\n", "1:1: error: there is no END to go to"},
    {"ORIMKS\n", "1:1: error: ORIMKS is not simulated"},
    {"G0 X=(1+2\n", "1:10: error: the bracket of the expression is not closed"},
    {"G0 X=SIN 30\n", "1:10: error: SIN needs its argument in ( )"},
    {"G0 X=1/0\n", "1:7: error: division of 1 by zero"},
    {"G0 C=ACP(30)\n", "1:6: error: ACP is not simulated"},
    {"G0 X=DC(5)\n", "1:6: error: DC() is for rotary axes"},
    {"T=\"MILL\"\n", "1:3: error: T has a name instead of a number"},
    {"T1 D2 M6\n", "1:4: error: D2 is not simulated"},
    {"T1 D1 M6\nG0 SUPA Z0\n",
     "2:4: error: SUPA with a tool length or TRAORI would place the tool's tip"},
    {"G0 A2=30\n", "1:4: error: A2= is not simulated"},
    {"G41 X0\n", "1:1: error: G41 is not simulated"},
    {"CYCLE800(1,\"T\",0,128,0,0,0,1,2,3)\n", "1:18: error: swivel mode 128 is not simulated"},
    {"CYCLE800(1,\"T\",1,57,0,0,0,1,2,3)\n",
     "1:16: error: CYCLE800 on top of another swivel is not simulated"},
    {"CYCLE800(0\n", "1:1: error: the bracket of CYCLE800 is not closed"},
    {"CYCLE800(0,\"T\",0,57,0,0,0,0,0,0,0,0,0,0,0,0,0)\n",
     "1:45: error: CYCLE800 has too many parameters"},
    {"CYCLE800(0,T)\n", "1:12: error: the swivel data record is a text"},
    {"MSG(\"open\n", "1:1: error: the text is not closed"},
    {"G0 A3=1 B3=0 C3=0\n", "1:4: error: A3=1 has no meaning in this block"},
    {"T1 D1 M6\nTRAORI\nG0 A3=0 B3=0 C3=0\n", "3:4: error: the tool vector has no direction"},
    {"T1 D1 M6\nTRAORI\nG0 A5 A3=0 B3=0 C3=1\n", "3:4: error: A5 and a tool vector in one block"},
    {"TRAORI\nG0 X1\n", "2:1: error: the tool-tip control is on, but no tool length is in force"},
    {"G4\n", "1:1: error: G4 without a time"},
    {"G4 F-1\n", "1:4: error: F-1 is negative"},
    {"G4 S5\n", "1:4: error: a dwell in revolutions with no spindle speed"},
    {"G0 X1 X2\n", "1:7: error: X is given twice in a block"},
    {"G0 X$AA_IM\n", "1:4: error: X has no number"},
    {"X1\n", "1:1: error: X1 has no meaning in this block"},
    {"G20\n", "1:1: error: unknown word G20"},
    {"TRAORI(2)\n", "1:1: error: TRAORI(2) is not simulated"},
    {"G0 X+\n", "1:4: error: X has no number"},
    {"R1\n", "1:1: error: R has no ="},
    {"N123456789 G0\n", "1:1: error: the block number is too large"},
    {"G0 X1 N5\n", "1:7: error: N is not the first word"},
    {"S1=500\n", "1:1: error: S1= is not simulated"},
    {"G1 X1 ) F5\n", "1:7: error: unexpected ')'"},
    {"G0 X0 Y0\nG1 X1 F1 CR=5\n", "2:10: error: CR=5 has no meaning in this block"},
    {"STOPRE G74 X1=0\n", "1:12: error: X1= is not simulated"},
    {"G331 Z5\n", "1:1: error: unknown word G331"},
    {"G507\n", "1:1: error: G507 is not simulated"},
    {"CR5\n", "1:1: error: unknown word CR5"},
    {"#1=2\n", "1:1: error: unexpected '#'"},
};

constexpr Mistake kHeidenhain[] = {
    {"L X+1 RL F100\n", "1:7: error: RL is not simulated"},
    {"L X+1 F100 X+2\n", "1:12: error: X is given twice in a block"},
    {"L Q1\n", "1:3: error: Q has no meaning in L"},
    {"CALL LBL 1\n", "1:1: error: no subprogram 1"},
    {"CYCL DEF 200\n", "1:1: error: CYCL DEF 200 has no Q200"},
    {"CYCL DEF 19.0\n", "1:1: error: CYCL DEF 19 is not simulated"},
    {"CYCL CALL\n", "1:1: error: CYCL CALL without a cycle"},
    {"CYCL DEF 7.1\n", "1:1: error: CYCL DEF 7 names no axis"},
    {"PLANE VECTOR\n", "1:1: error: PLANE VECTOR needs two vectors"},
    {"PLANE PROJECTED PROPR+0\n", "1:1: error: PLANE PROJECTED is not simulated"},
    {"PLANE SPATIAL SPA+0 SPB+0 STAY\n", "1:1: error: PLANE SPATIAL needs three angles"},
    {"PLANE SPATIAL SPA+0 SPB+0 SPC+0\n",
     "1:1: error: PLANE SPATIAL does not say whether the axes turn"},
    {"PLANE SPATIAL SPA+0 SPB+0 SPC+0 MOVE\n", "1:33: error: PLANE ... MOVE is not simulated"},
    {"PLANE RESET TURN FOO\n", "1:18: error: FOO has no meaning in PLANE"},
    {"FUNCTION TCPM F CONT AXIS POS\n", "1:15: error: F CONT is not simulated"},
    {"FUNCTION TCPM F TCP AXIS SPAT\n", "1:21: error: AXIS SPAT is not simulated"},
    {"FUNCTION TURN\n", "1:1: error: FUNCTION TURN is not simulated"},
    {"TOOL CALL \"MILL\" Z\n", "1:11: error: TOOL CALL has a name instead of a number"},
    {"TOOL CALL 1 X\n", "1:13: error: tool axis X is not simulated"},
    {"TOOL CALL 1 Z DR+0.1\n", "1:15: error: DR is not simulated"},
    {"TOOL 5\n", "1:1: error: TOOL without CALL or DEF"},
    {"C X+1 DR+\n", "1:1: error: the start of the arc is not known: X has not been programmed yet"},
    {"L X+0 Y+0 FMAX\nCC X+1 Y+0\nC X+2 Y+0\n", "3:1: error: C has no direction"},
    {"CR X+1 Y+1 DR+\n", "1:1: error: CR has no radius"},
    {"L R+5\n", "1:3: error: a radius in L"},
    {"CC Z+5\n", "1:4: error: Z has no meaning in CC"},
    {"LN X+1 TX+0 TY+0 TZ+1 FMAX\n", "1:8: error: TX0 has no meaning in this block"},
    {"L X+1\n", "1:1: error: a cutting move without a feed rate"},
    {"L F AUTO X+1\n", "1:3: error: F AUTO without a feed in the tool call"},
    {"L X+1 FU0.1\n", "1:7: error: FU is not simulated"},
    {"L X+1 FT0\n", "1:7: error: FT0 is not above zero"},
    {"APPR LT X+1\n", "1:1: error: APPR is not simulated"},
    {"X+1\n", "1:1: error: unknown statement X"},
    {"L TX+1\n", "1:3: error: TX has no meaning in L"},
    {"M140 MB MAX\n", "1:1: error: M140 is not simulated"},
    {"M128\nL X+1 FMAX\n",
     "2:1: error: the tool-tip control is on, but no tool length is in force"},
    {"BEGIN PGM A\n", "1:11: error: BEGIN PGM has no unit"},
    {"BEGIN A\n", "1:1: error: BEGIN without PGM"},
    {"CR X+1 FMAX R+5 DR+\n", "1:1: error: CR with FMAX"},
    {"L X\n", "1:3: error: X has no number"},
    {"L X+1 FMAX ?\n", "1:12: error: unexpected '?'"},
    {"CYCL DEF 247 DATUM SETTING\n", "1:1: error: CYCL DEF 247 without a number"},
    {"CYCL DEF 247 Q338=1\n", "1:14: error: Q338 has no meaning in CYCL DEF 247"},
    {"L IX+1 FMAX\n", "1:3: error: IX1 is incremental, but X has not been programmed yet"},
    {"L M97\n", "1:3: error: M97 is not simulated"},
    {"STOP X+1\n", "1:6: error: X has no meaning in STOP"},
    {"123456789 L X+1\n", "1:1: error: the line number is too large"},
};

constexpr Mistake kCldata[] = {
    {"GOTO/1,2\n", "1:1: error: GOTO with 2 numbers"},
    {"GOTO/1,2,A\n", "1:10: error: A has no meaning in GOTO"},
    {"GOTO/1,,2\n", "1:8: error: an argument is missing"},
    {"GOTO/1,2,3\n", "1:1: error: a cutting move without a feed rate"},
    {"LOADTL/1\nGOTO/1,2,3\n", "2:1: error: a cutting move without a feed rate"},
    {"RAPID\nGOTO/1,2,3,1,0,0\n", "2:12: error: i 1 has no meaning in this block"},
    {"MULTAX/ON\nRAPID\nGOTO/1,2,3\n",
     "3:1: error: the tool-tip control is on, but no tool length is in force"},
    {"MULTAX/ON\nLOADTL/1\nRAPID\nGOTO/1,2,3,0,0,0\n",
     "4:12: error: the tool vector has no direction"},
    {"MULTAX/MAYBE\n", "1:1: error: MULTAX without ON or OFF"},
    {"CIRCLE/0,0,0,0,0,1\n", "1:1: error: CIRCLE with 6 numbers"},
    {"CIRCLE/0,0,0,.6,0,.8,5\n", "1:14: error: the circle does not lie in a plane of X, Y, Z"},
    {"CIRCLE/0,0,0,0,0,1,5\nFINI\n", "2:1: error: the CIRCLE on line 1 has no GOTO"},
    {"RAPID\nGOTO/0,0,0\nFEDRAT/5\nCIRCLE/5,0,0,0,0,1,5\nGOTO/3,0,0\n",
     "5:1: error: the start of the arc is 5 mm from the centre, its end 2 mm: 3 mm apart"},
    {"FEDRAT/5,BOGUS\n", "1:10: error: BOGUS has no meaning in FEDRAT"},
    {"FEDRAT/MMPM\n", "1:1: error: FEDRAT has no feed"},
    {"FEDRAT\n", "1:1: error: FEDRAT has no feed"},
    {"SPINDL/FAST\n", "1:8: error: FAST has no meaning in SPINDL"},
    {"SPINDL\n", "1:1: error: SPINDL says nothing"},
    {"LOADTL/T1\n", "1:1: error: LOADTL has no number"},
    {"UNITS/FEET\n", "1:1: error: UNITS without MM or INCHES"},
    {"COOLNT/WET\n", "1:1: error: COOLNT says nothing that is known"},
    {"DELAY\n", "1:1: error: DELAY without a time"},
    {"CYCLE/DRILL,5\n", "1:1: error: CYCLE has no feed"},
    {"CUTCOM/LEFT\n", "1:1: error: CUTCOM is not simulated"},
    {"GOTO\n", "1:1: error: GOTO with 0 numbers"},
    {"FOO/1\n", "1:1: error: unknown record FOO"},
    {"123\n", "1:1: error: unexpected '1'"},
    {"END/1\n", "1:5: error: END takes no arguments"},
    {"GODLTA/5\n", "1:1: error: GODLTA with 1 numbers"},
    {"GODLTA/1,2,3\n", "1:8: error: X1 is incremental, but X has not been programmed yet"},
    {"DELAY/3,REV\n", "1:7: error: a dwell in revolutions with no spindle speed"},
    {"GOTO/1,2,3 4\n", "1:12: error: unexpected '4'"},
    {"FEDRAT/5,6\n", "1:10: error: FEDRAT has more than a feed and its unit"},
    {"TRACUT/1\n", "1:1: error: TRACUT is not simulated"},
    {"GOTO/1E999,2,3\n", "1:6: error: the number is too large"},
    {"LOADTL/1.5\n", "1:8: error: tool 1.5 is not a whole number"},
    {"DELAY/-1\n", "1:7: error: DELAY/-1 is negative"},
    {"RAPID\nRAPID/1\n", "2:7: error: RAPID takes no arguments"},
};

void expect_complaints(Dialect dialect, std::span<const Mistake> mistakes) {
  EXPECT_GE(mistakes.size(), 15U);
  for (const Mistake& mistake : mistakes) {
    const auto lines = complaints(mistake.text, {}, dialect);
    ASSERT_EQ(lines.size(), 1U) << mistake.text;
    const std::size_t hint = lines[0].find(" (hint: ");
    EXPECT_NE(hint, std::string::npos) << lines[0];
    EXPECT_EQ(lines[0].substr(0, hint), mistake.complaint) << mistake.text;
  }
}

TEST(DialectErrors, OfLinuxcnc) { expect_complaints(Dialect::linuxcnc, kLinuxcnc); }
TEST(DialectErrors, OfSinumerik) { expect_complaints(Dialect::sinumerik, kSinumerik); }
TEST(DialectErrors, OfHeidenhain) { expect_complaints(Dialect::heidenhain, kHeidenhain); }
TEST(DialectErrors, OfCldata) { expect_complaints(Dialect::cldata, kCldata); }

}  // namespace
}  // namespace frustum::parser
