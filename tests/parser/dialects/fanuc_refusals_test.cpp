// What the words of Fanuc refuse, and how: place, message and remedy.
#include <gtest/gtest.h>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

struct FanucMistake {
  const char* text;
  const char* complaint;  // "line:column: error: message", without the hint
};

constexpr FanucMistake kFrames[] = {
    {"G68.2 P5 X0\n", "1:7: error: P5 is out of range"},
    {"G68.2 P1 Q112 I10\n", "1:10: error: Q112 is no order of turns"},
    {"G68.2 I10 R5\n", "1:11: error: R5 has no meaning in G68.2 P0"},
    {"G68.2 P2 X0 Y0 Z0\n", "1:1: error: G68.2 P2 without Q"},
    {"G68.2 P3 Q0 I1\n", "1:10: error: Q0 is out of range"},
    {"G68.2 P3 Q2 X5 K1\n", "1:13: error: X5 has no meaning in G68.2 P3"},
    {"G68.2 P2 Q1 X0\nG68.2 P2 Q2 X5\nG68.2 P2 Q3 X9\n",
     "3:10: error: the three points of the plane are on one line"},
    {"G68.2 P3 Q1 I1\nG68.2 P3 Q2 I1\n", "2:10: error: the two vectors span no plane"},
    {"G68.2 P3 Q1 I1\nG68.2 P3 Q2 I0.5 K1\n",
     "2:10: error: the two vectors are 26.5651 degrees off the right angle"},
    {"G68.2 P4 I90 J90\n", "1:1: error: the two lines of the plane are parallel"},
    {"G68.2 P2 Q1 X0\nG68.2 P2 Q3 Y5\nG0 X0\n",
     "3:1: error: a move while the tilted plane is described by halves"},
    {"G68.4 I10\n", "1:1: error: G68.4 without a tilted plane"},
    {"G68.3 X0 Y0 Z0\n", "1:1: error: G68.3 is not simulated"},
    {"G53.6\n", "1:1: error: G53.6 is not simulated"},
    {"G68 X0 Y0\n", "1:1: error: G68 without an angle"},
    {"G68 X0 Y0 Z0 I0 R9\n", "1:14: error: the axis of the turn has no direction"},
    {"G68 X0 Y0 I1 R9\n",
     "1:1: error: the centre of G68 is not known: Z has not been programmed yet"},
    {"G0 X0 Y0 Z0\nG68 X0 Y0 R9\nG18 G91 G68 X0 Z0 R5\n",
     "3:1: error: G18 within a rotation by G68"},
    {"G68 X0 Y0 R90\nG52 X0\n", "2:1: error: G52 within a rotation by G68"},
    {"G0 X0 Y0\nG68 X0 Y0 R90\nG92 X5\n", "3:1: error: G92 within a rotation by G68"},
    {"G51.1 X0\nG68.2 X0 I5\n", "2:1: error: G68.2 while the words are mirrored or scaled"},
    {"G51 P2.\n", "1:1: error: the centre of G51 is not known: X has not been programmed yet"},
    {"G51 X0 Y0 Z0\n", "1:1: error: G51 without a factor"},
    {"G51 X0 Y0 Z0 P0\n", "1:14: error: P0 is not above zero"},
    {"G51 X0 Y0 Z0 P-1.\n", "1:14: error: P-1 is not above zero"},
    {"G51 X0 Y0 Z0 P100000.\n", "1:14: error: P100000 is out of range"},
    {"G6.2 P4 X1\n", "1:1: error: G6.2 is not simulated"},
    {"G7.1 C50\n", "1:1: error: G7.1 is not simulated"},
    {"G12.1\n", "1:1: error: G12.1 is not simulated"},
    {"G51 X0 Y0 Z0 I2. J2. K1.\n", "1:22: error: K1 scales one axis other than the rest"},
    {"G51 X0 Y0 Z0 I2. J2.\n", "1:14: error: G51 scales without K"},
    {"G0 X0 Y0 Z0\nG68 X0 Y0 R9\nG51 P2.\n", "3:1: error: G51 within a turned frame"},
    {"G51.1\n", "1:1: error: G51.1 names no axis"},
    {"G0 X0 Y0 Z0\nG51 P2.\nG51.1 X0\n", "3:1: error: G51.1 within a turned or scaled frame"},
    {"G51.1 X0\nG43.4 H1\nG0 X0 Y0 Z0\n",
     "3:1: error: a move with tool-tip control in a mirrored frame"},
    {"G0 X0 Y0 Z0\nG51.1 Z0\nG81 R2 Z-3 F10\n",
     "3:1: error: a canned cycle where the depths are scaled or mirrored"},
    {"G16\nG0 Y90\n", "2:4: error: an angle in G16, but no radius yet"},
    {"G16 G91 G0 X5 Y90\n",
     "1:12: error: the radius counts from where the tool is, but X has not been programmed yet"},
    {"G0 X0 Y0\nG16 G2 X10 Y0 I5 F10\n", "2:15: error: I5 of an arc in G16"},
};

template <std::size_t Count>
void expect_complaints(const FanucMistake (&mistakes)[Count]) {
  for (const FanucMistake& mistake : mistakes) {
    const auto lines = complaints(mistake.text);
    EXPECT_EQ(lines.size(), 1U) << mistake.text;
    if (lines.empty()) continue;
    const std::size_t hint = lines[0].find(" (hint: ");
    EXPECT_NE(hint, std::string::npos) << lines[0];
    EXPECT_EQ(lines[0].substr(0, hint), mistake.complaint) << mistake.text;
  }
}

constexpr FanucMistake kMacros[] = {
    {"G65 P1 N5 A1\n", "1:8: error: N is not the first word"},
    {"G65 P1.5\n", "1:5: error: P1.5 is not a whole number"},
    {"G65 P0\n", "1:5: error: P0 is out of range"},
    {"G65 P1 L-1\n", "1:8: error: L-1 is out of range"},
    {"G65 P1 A1 A2\n", "1:11: error: A is given twice in a block"},
    {"G65 P1 G0\n", "1:8: error: G0 beside G65"},
    {"#1=2 G65 P1\n", "1:1: error: a setting beside G65"},
    {"G66 A1\n", "1:1: error: G66 without P"},
    {"G66 P77\nG0 X1\n", "2:1: error: subprogram O77 does not exist"},
    {"G66.1 P1\n", "1:1: error: G66.1 is not simulated"},
    {"G66 P1\nG0 X1 M98 P1\nM30\nO1\nM99\n",
     "2:1: error: a call or M99 beside a move, which calls the macro of G66"},
    {"G65 P1 I1 I2 I3 I4 I5 I6 I7 I8 I9 I10 I11\n",
     "1:39: error: more than ten I J K of a macro call"},
    {"M198 P1\n", "1:1: error: M198 is not simulated"},
    {"M98 P2\nM30\nO2\nM99 P7\n", "4:5: error: there is no N7 to go back to"},
    {"M99 P7\n", "1:5: error: there is no N7 to go to"},
    {"M98 P2\nM30\nO2\nM99 P1.5\n", "4:5: error: P1.5 is not a whole number"},
    {"#3000=5(TOOL BROKEN)\n", "1:1: error: the program raises alarm 5: TOOL BROKEN"},
    {"#3000=1\n", "1:1: error: the program raises alarm 1"},
    {"#1=#3001\nG4 P#1\n", "2:4: error: P depends on #3001, which only the machine knows"},
    {"#3011=0\n", "1:1: error: system variable #3011 is not simulated"},
    {"#5221=#5021\n", "1:1: error: #5221 is set to a value that only the machine knows"},
    {"IF[#3020GT1]GOTO1\nN1\n",
     "1:1: error: what comes next depends on #3020, which only the machine knows"},
    {"M98 P1 H50\nM30\nO1\nM99\n", "1:8: error: H50 beside M98"},
    {"M96 P1 Q8\n", "1:1: error: M96 P is not simulated"},
    {"M97 P7\nM30\n", "1:5: error: there is no N7 to call"},
    {"M97 P7\nM30\nN7 G0 X1\n", "3:1: error: subprogram N7 has no M99"},
    {"#4001=1\n", "1:1: error: system variable #4001 is not simulated"},
    {"G0 X#5021\n", "1:4: error: X depends on #5021, which only the machine knows"},
    {"G0 X#5001\n", "1:4: error: X depends on #5001, which only the machine knows"},
    {"SETVN 500[A,B]\n", "1:1: error: SETVN is not simulated"},
    {"DPRNT X#1\n", "1:7: error: DPRNT has no text"},
    {"DPRNT[X#1[53]]\nDPRNT[X\n", "2:6: error: the bracket is not closed"},
    {"G0 X[1 EQ 1 AND 2 EQ 2]\n", "1:19: error: unexpected 'E' in an expression"},
    {"G0 X[1.5 AND 2]\n", "1:10: error: the bits of 1.5 and 2"},
    {"G0 X[5 MOD 0.2]\n", "1:8: error: 5 MOD zero"},
    {"G0 XPOW[2]\n", "1:10: error: POW needs two values"},
    {"G0 XPOW[-2,0.5]\n", "1:5: error: -2 ** 0.5 has no real value"},
    {"G0 XBCD[-1]\n", "1:5: error: BCD of -1"},
    {"G0 XBIN[10]\n", "1:5: error: BIN of 10"},
};

constexpr FanucMistake kCycles[] = {
    {"G0 X0 Y0 Z9\nG76 R2 Z-9 F50\n", "2:1: error: the cycle has no Q"},
    {"G0 X0 Y0 Z9\nG87 R-9 Z-5 F50\n", "2:1: error: the cycle has no Q"},
    {"G0 X0 Y0 Z9\nG87 R-5 Z-9 Q1 F50\n",
     "2:1: error: G87 bores from R (-5 mm) up to Z (-9 mm), below the tool (9 mm)"},
    {"G73 R2 Z-9 F50\n",
     "1:1: error: the cycle starts at an unknown Z: Z has not been programmed yet"},
    {"G0 X0 Y0 Z9\nG83 R2 Z-9 F50\n", "2:1: error: the cycle has no Q"},
    {"G0 X0 Y0 Z9\nG81 R2 Z-9 F50 K1.5\n", "2:16: error: K1.5 is not a whole number"},
    {"G27\n", "1:1: error: G27 names no axis"},
    {"G29\n", "1:1: error: G29 names no axis"},
    {"G29 X0\n", "1:5: error: G29 goes by the place of G28, which has none for X"},
    {"G91 G28 Z0\nG90 G29 Z5\n", "2:9: error: G29 goes by the place of G28, which has none for Z"},
    {"G0 X1\nG1 G27 X0 F9\n", "2:1: error: G27 and G1 both use the axis words"},
    {"G31\n", "1:1: error: G31 names no axis"},
    {"G31 Z-5 F0\n", "1:1: error: a probing move without a feed rate"},
    {"G1 G31 Z-5 F9\n", "1:1: error: G31 and G1 both use the axis words"},
    {"G0 Z5\nG31 Z5 F9\n", "2:1: error: the probing move ends where it starts"},
    {"G31 Z-5 F9 P1\n", "1:12: error: P1 has no meaning in this block"},
    {"G0 X#5061\n", "1:4: error: X depends on #5061, which only the machine knows"},
    {"G0 X0 Y0 Z9\nG81 R2 Z-9 F50 L0\nG71 I5 L3\n", "3:1: error: G71 has no K"},
    {"G0 X0 Y0 Z9\nG70 I5 L3\n", "2:5: error: I5 has no meaning in this block"},
    {"G13 I5. F100\n", "1:1: error: G13 is not simulated"},
    {"G47 P0 (AB) J5. F100\n", "1:1: error: G47 is not simulated"},
    {"G31.1 Z-5 F9\n", "1:1: error: G31.1 is not simulated"},
    {"S9 M3\nG33 Z-5\n", "2:1: error: G33 without F"},
    {"S9 M3 F500\nG33 Z-5\n", "2:1: error: G33 without F"},
    {"S9 M3\nG33 F1\nG33 Z-5 F0\n", "3:9: error: F0 is not above zero"},
    {"G33 Z-5 F1\n", "1:1: error: G33 while the spindle is at rest"},
    {"S9 M3\nG33 Z-5 F1 Q90\n", "2:12: error: Q90 has no meaning in this block"},
    {"S9 M3\nG33 Z-5 F1 K1\n", "2:12: error: K1 has no meaning in this block"},
    {"S9 M3\nG93 G33 Z-5 F1\n", "2:5: error: a thread in G93, where F is a time"},
    {"G32 Z-5 F1\n", "1:1: error: G32 is not simulated"},
};

TEST(FanucErrors, OfCycles) { expect_complaints(kCycles); }
TEST(FanucErrors, OfMacros) { expect_complaints(kMacros); }
TEST(FanucErrors, OfFrames) { expect_complaints(kFrames); }

}  // namespace
}  // namespace frustum::parser
