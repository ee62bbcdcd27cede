// Texts that no editor writes: numbers without end, recursion, bytes of other files, depth. Each
// has its complaint.
#include <gtest/gtest.h>

#include <ctime>

#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

const std::string kDigits(400, '9');

// A text with a part that is repeated. It is put together only where it is read, since these
// tables are made in each of the thousand starts of the program, one for every test of the room.
struct Repetitive {
  std::string before;
  std::string_view part{};
  int times = 0;
  std::string after{};

  Repetitive(const char* text) : before(text) {}             // NOLINT: so that the table is short
  Repetitive(std::string text) : before(std::move(text)) {}  // NOLINT
  Repetitive(std::string head, std::string_view repeated, int number, std::string tail = "")
      : before(std::move(head)), part(repeated), times(number), after(std::move(tail)) {}

  [[nodiscard]] std::string whole() const {
    std::string text = before;
    for (int i = 0; i < times; ++i) text += part;
    return text + after;
  }
};

struct Extreme {
  std::string name;
  Dialect dialect;
  Repetitive text;
  std::string complaint;  // the first, without the hint
};
void PrintTo(const Extreme& extreme, std::ostream* out) { *out << extreme.name; }

using enum Dialect;
const std::vector<Extreme> kExtremes{
    // Numbers.
    {"FanucDigits", fanuc, "G0 X" + kDigits, "1:5: error: the number is too large"},
    {"LinuxcncDigits", linuxcnc, "G0 X-" + kDigits, "1:6: error: the number is too large"},
    {"SinumerikDigits", sinumerik, "G0 X" + kDigits, "1:5: error: the number is too large"},
    {"HeidenhainDigits", heidenhain, "L X+" + kDigits, "1:5: error: the number is too large"},
    {"CldataDigits", cldata, "GOTO/" + kDigits + ",0,0", "1:6: error: the number is too large"},
    {"CldataExponent", cldata, "GOTO/0,1.0E+400,0", "1:8: error: the number is too large"},
    {"FanucBeyondMachines", fanuc, "G0 X1" + std::string(300, '0'), "1:4: error: X is too large"},
    {"FanucComputedBeyondMachines", fanuc, "#1=10**16\nG0 Y#1", "2:4: error: Y is too large"},
    {"LinuxcncFeedBeyondMachines", linuxcnc, "F[10**16]", "1:1: error: F is too large"},
    {"SinumerikBeyondMachines", sinumerik, "G0 X=1" + std::string(300, '0'),
     "1:4: error: X is too large"},
    {"HeidenhainBeyondMachines", heidenhain, "L IX+1" + std::string(300, '0'),
     "1:3: error: IX is too large"},
    {"FanucVacantParameterNumber", fanuc, "#[#1]=5",
     "1:1: error: the number of the parameter is vacant"},
    {"FanucBlockNumber", fanuc, "N" + kDigits, "1:2: error: the number is too large"},
    {"LinuxcncBlockNumber", linuxcnc, "N" + kDigits, "1:2: error: the number is too large"},
    {"SinumerikBlockNumber", sinumerik, "N" + kDigits + " G0",
     "1:1: error: the block number is too large"},
    {"HeidenhainBlockNumber", heidenhain, kDigits + " L X+1",
     "1:1: error: the line number is too large"},
    {"FanucProgramNumber", fanuc, "O" + kDigits, "1:2: error: the number is too large"},
    {"LinuxcncLabel", linuxcnc, "o" + kDigits + " sub", "1:2: error: the number is too large"},
    {"FanucParameterNumber", fanuc, "#" + kDigits + "=1", "1:2: error: the number is too large"},
    {"FanucPower", fanuc, "#1=2**2000", "1:5: error: the result is too large for a number"},
    {"LinuxcncProduct", linuxcnc, "#1=[10**300*10**300]",
     "1:12: error: the result is too large for a number"},
    {"SinumerikExponential", sinumerik, "R1=EXP(1000)",
     "1:4: error: the result is too large for a number"},
    {"HeidenhainPower", heidenhain, "Q1 = 10 ^ 400",
     "1:9: error: the result is too large for a number"},
    {"FanucToolNumber", fanuc, "T1" + std::string(12, '0'),
     "1:1: error: T1000000000000 is out of range"},
    // Recursion and loops without end.
    {"FanucCallsItself", fanuc, "M98 P1\nM30\nO1\nM98 P1\nM99\n",
     "4:5: error: more than 32 subprograms within each other"},
    {"FanucCallsEachOther", fanuc, "M98 P1\nM30\nO1\nM98 P2\nM99\nO2\nM98 P1\nM99\n",
     "7:5: error: more than 32 subprograms within each other"},
    {"FanucMacroCallsItself", fanuc, "G65 P1\nM30\nO1\nG65 P1 A1\nM99\n",
     "4:5: error: more than 32 subprograms within each other"},
    {"LinuxcncCallsItself", linuxcnc, "o1 sub\no1 call\no1 endsub\no1 call\n",
     "2:1: error: more than 32 subprograms within each other"},
    {"LinuxcncCallsEachOther", linuxcnc,
     "o<a> sub\no<b> call\no<a> endsub\no<b> sub\no<a> call\no<b> endsub\no<a> call\n",
     "5:1: error: more than 32 subprograms within each other"},
    {"HeidenhainCallsItself", heidenhain, "CALL LBL 1\nM30\nLBL 1\nCALL LBL 1\nLBL 0\n",
     "4:1: error: more than 32 subprograms within each other"},
    {"FanucJumpsToItself", fanuc, "N1 GOTO 1\n",
     "1:1: error: more than 2000 blocks have run again"},
    {"FanucLoop", fanuc, "WHILE[1EQ1]DO1\nEND1\n",
     "1:1: error: more than 2000 blocks have run again"},
    {"LinuxcncLoop", linuxcnc, "o1 do\no1 while [1]\n",
     "2:1: error: more than 2000 blocks have run again"},
    {"LinuxcncRepeats", linuxcnc,
     "o1 repeat [1000000000]\no2 repeat [1000000000]\no2 endrepeat\no1 endrepeat\n",
     "3:1: error: more than 2000 blocks have run again"},
    {"SinumerikLoop", sinumerik, "LOOP\nENDLOOP\n",
     "2:1: error: more than 2000 blocks have run again"},
    {"SinumerikJumpsBack", sinumerik, "HERE:\nGOTOB HERE\n",
     "1:1: error: more than 2000 blocks have run again"},
    {"HeidenhainLoop", heidenhain, "LBL 1\nFN 9: IF +1 EQU +1 GOTO LBL 1\n",
     "1:1: error: more than 2000 blocks have run again"},
    {"FanucRepeatsWithinRepeats", fanuc, "M98 P1 L99999\nM30\nO1\nM98 P2 L99999\nM99\nO2\nM99\n",
     "6:1: error: more than 2000 blocks have run again"},
    // Into the void.
    {"FanucGoto", fanuc, "GOTO 99999\n", "1:1: error: there is no N99999 to go to"},
    {"FanucGotoOfTheNextProgram", fanuc, "GOTO 1\nM30\nO2\nN1\nM99\n",
     "1:1: error: there is no N1 to go to"},
    {"FanucGotoComputed", fanuc, "IF[1EQ1]GOTO[1/0]\n", "1:15: error: division of 1 by zero"},
    {"FanucGotoBelowZero", fanuc, "GOTO[-1]\n",
     "1:1: error: -1 is no number of a block or subprogram"},
    {"SinumerikGotoBehind", sinumerik, "N5 G0 X1\nGOTOF N5\nM30\n",
     "2:1: error: there is no N5 to go to"},
    {"SinumerikGotoAhead", sinumerik, "GOTOB N5\nN5 M30\n", "1:1: error: there is no N5 to go to"},
    {"HeidenhainGoto", heidenhain, "FN 9: IF +1 EQU +1 GOTO LBL \"NO\"\n",
     "1:1: error: there is no NO to go to"},
    {"LinuxcncCall", linuxcnc, "o9 call\n", "1:1: error: no subprogram 9"},
    {"LinuxcncCallComputed", linuxcnc, "o[1.5] call\n",
     "1:1: error: 1.5 is no number of a block or subprogram"},
    {"FanucCall", fanuc, "M98 P7\n", "1:5: error: subprogram O7 does not exist"},
    // Not closed at the end of the file, which has no line feed.
    {"FanucComment", fanuc, "G0 X1\n(no end", "2:1: error: the comment is not closed"},
    {"LinuxcncCommentBehindOWord", linuxcnc, "o1 call (no end",
     "1:9: error: the comment is not closed"},
    {"SinumerikMessage", sinumerik, "MSG(\"no end", "1:1: error: the text is not closed"},
    {"SinumerikCall", sinumerik, "CYCLE800(1,\"T", "1:12: error: the text is not closed"},
    {"HeidenhainName", heidenhain, "CALL LBL \"NO", "1:10: error: the name is not closed"},
    {"FanucName", fanuc, "#<name", "1:7: error: the parameter name is not closed"},
    {"LinuxcncName", linuxcnc, "o<name", "1:2: error: the name is not closed"},
    {"FanucBracket", fanuc, "G0 X[1+", "1:5: error: the bracket is not closed"},
    {"FanucCondition", fanuc, "WHILE[1", "1:6: error: the bracket is not closed"},
    {"SinumerikCondition", sinumerik, "IF (R1",
     "1:7: error: the bracket of the expression is not closed"},
    {"HeidenhainBracket", heidenhain, "Q1 = (2", "1:6: error: the bracket is not closed"},
    {"HeidenhainContinuation", heidenhain, "L X~", "1:3: error: X has no number"},
    {"CldataArguments", cldata, "GOTO/1,2,", "1:10: error: an argument is missing"},
    {"CldataContinuation", cldata, "GOTO/1,2,$", "1:10: error: an argument is missing"},
    {"FanucValue", fanuc, "#1=", "1:1: error: the parameter setting has no value"},
    {"SinumerikValue", sinumerik, "G0 X=", "1:6: error: a number is missing"},
    // Bytes of other files.
    {"FanucZeroByte", fanuc, std::string("G0 \0X1", 6), "1:4: error: unexpected byte 0x00"},
    {"LinuxcncZeroByte", linuxcnc, std::string("G0 \0X1", 6), "1:4: error: unexpected byte 0x00"},
    {"SinumerikZeroByte", sinumerik, std::string("G0 \0X1", 6), "1:4: error: unexpected byte 0x00"},
    {"HeidenhainZeroByte", heidenhain, std::string("L \0X1", 5),
     "1:3: error: unexpected byte 0x00"},
    {"HeidenhainZeroByteInACycle", heidenhain, std::string("CYCL DEF 200 C\0", 15),
     "1:15: error: unexpected byte 0x00"},
    {"CldataZeroByte", cldata, std::string("GOTO \0X1", 8), "1:6: error: unexpected byte 0x00"},
    {"FanucLatinLetter", fanuc, "G0 X1 \xFC", "1:7: error: unexpected byte 0xFC"},
    {"SinumerikTornCharacter", sinumerik, "G0 \xC3", "1:4: error: unexpected byte 0xC3"},
    {"HeidenhainWideText", heidenhain, "\xFE\xFFL", "1:1: error: unexpected byte 0xFE"},
    {"FanucEscape", fanuc, "\x1B[0m", "1:1: error: unexpected byte 0x1B"},
    // Length and depth.
    {"FanucLongLine", fanuc, {"G0X1", " ", 1'000'000, "?"}, "1:1000005: error: unexpected '?'"},
    {"FanucLongComment", fanuc, {"(", "x", 1'000'000}, "1:1: error: the comment is not closed"},
    {"FanucManySigns", fanuc, {"G0 X", "-", 100'000, "1"}, "1:4: error: X has no number"},
    {"FanucParameterChain",
     fanuc,
     {"", "#", 100'000, "1=1"},
     "1:66: error: more than 64 brackets within each other"},
    {"FanucBrackets",
     fanuc,
     {"X", "[", 100'000},
     "1:66: error: more than 64 brackets within each other"},
    {"FanucFunctions",
     fanuc,
     {"X", "SIN[", 10'000},
     "1:261: error: more than 64 brackets within each other"},
    {"FanucLongSum", fanuc, {"X[", "1+", 50'000}, "1:2: error: the bracket is not closed"},
    {"SinumerikBrackets",
     sinumerik,
     {"X=", "(", 100'000},
     "1:68: error: too many brackets within each other"},
    {"SinumerikSigns",
     sinumerik,
     {"X=", "-", 100'000, "1"},
     "1:68: error: too many brackets within each other"},
    {"SinumerikNots",
     sinumerik,
     {"IF ", "NOT ", 10'000, "R1\nENDIF\n"},
     "1:264: error: too many brackets within each other"},
    {"HeidenhainBrackets",
     heidenhain,
     {"Q1 = ", "(", 100'000},
     "1:71: error: too many brackets within each other"},
    {"HeidenhainFunctions",
     heidenhain,
     {"Q1 = ", "SIN ", 10'000, "1"},
     "1:266: error: too many brackets within each other"},
    {"CldataArgumentsWithoutEnd",
     cldata,
     {"GOTO/", "1,", 100'000},
     "1:200006: error: an argument is missing"},
    {"CldataContinuedWithoutEnd",
     cldata,
     {"GOTO/1,2,$\n", "$\n", 10'000, "X"},
     "10002:1: error: X has no meaning in GOTO"},
    {"LinuxcncOpenBranches", linuxcnc, {"", "o1 if [1]\n", 3}, "1:1: error: if 1 has no end"},
};

class ExtremeText : public testing::TestWithParam<Extreme> {};

TEST_P(ExtremeText, SaysWhereWhatAndTheRemedy) {
  InterpreterOptions options;
  options.max_blocks = 2000;
  const auto lines = complaints(GetParam().text.whole(), options, GetParam().dialect);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0].substr(0, lines[0].find(" (hint: ")), GetParam().complaint);
  EXPECT_NE(lines[0].find(" (hint: "), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Texts, ExtremeText, testing::ValuesIn(kExtremes),
                         [](const auto& test) { return test.param.name; });

TEST(ExtremeTexts, NumbersThatAreTooSmallAreZero) {
  const std::string tiny = "0." + std::string(400, '0') + "1";
  const auto x_of = [](const std::string& text, Dialect dialect) {
    return *last_of<Traverse>(motions(text, {}, dialect)).end[AxisLetter::X];
  };
  EXPECT_EQ(x_of("G0 X" + tiny, Dialect::fanuc), 0.0);
  EXPECT_EQ(x_of("G0 X" + tiny, Dialect::sinumerik), 0.0);
  EXPECT_EQ(x_of("L X+" + tiny + " FMAX", Dialect::heidenhain), 0.0);
  EXPECT_EQ(x_of("RAPID\nGOTO/1.0E-400,0,0", Dialect::cldata), 0.0);
}

TEST(ExtremeTexts, CommentsOfAnyBytesAreText) {
  const auto events = all_of<Event>(motions(std::string("G0 X1 (\xFF\0\xC3)\n", 11)));
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].text, std::string("\xC3\xBF\0\xC3\x83", 5));
}

// A jump does not read the program again.
TEST(ExtremeTexts, ManyJumpsOverManyBlocksTakeNoTime) {
  std::string text = "#1=0\nN1 #1=#1+1\nIF[#1LT5000]GOTO 99\nM30\n";
  for (int i = 0; i < 20'000; ++i) text += "G4 P0\n";
  text += "N99 GOTO 1\n";
  const auto start = std::clock();
  EXPECT_TRUE(complaints(text).empty());
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 2.0);
}

}  // namespace
}  // namespace frustum::parser
