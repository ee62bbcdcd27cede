// No text whatever may crash the parser or the interpreter, or make them run for ever.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "parser/interpreter.hpp"
#include "parser/writing/canonical_json.hpp"
#include "tests/law_count.hpp"
#include "tests/parser/random_program.hpp"

namespace frustum::parser {
namespace {

const InterpreterOptions kShort{.block_delete = false, .max_call_depth = 32, .max_blocks = 2000};

// Reads and runs; a failure must say where and what to do.
void survive(const std::string& text) {
  const auto check = [&text](const Diagnostics& diagnostics) {
    ASSERT_TRUE(has_error(diagnostics));
    for (const Diagnostic& diagnostic : diagnostics) {
      ASSERT_FALSE(diagnostic.message.empty());
      ASSERT_FALSE(diagnostic.hint.empty()) << diagnostic.message << "\n" << text;
      ASSERT_EQ(diagnostic.message.find("boost"), std::string::npos) << diagnostic.message;
      ASSERT_EQ(diagnostic.hint.find("boost"), std::string::npos) << diagnostic.hint << "\n"
                                                                  << text;
    }
  };
  const auto program = parse_program(text, "fuzz.nc");
  if (!program) return check(program.error());
  std::size_t letters = 0;
  const auto summary = interpret(
      *program, [&letters](Motion&& motion) { letters += to_json_line(motion).size(); }, kShort);
  if (summary) return;
  check(summary.error());
  for (const Diagnostic& diagnostic : summary.error()) {
    ASSERT_GT(diagnostic.line, 0) << diagnostic.message;
    ASSERT_GT(diagnostic.column, 0) << diagnostic.message;
  }
}

TEST(RobustnessLaws, RandomBytesDoNoHarm) {
  for (std::uint64_t seed = 1; seed <= proof::law_count(3000U, 500U); ++seed) {
    Dice dice(seed);
    std::string text;
    for (std::size_t i = dice.below(200); i > 0; --i) text += static_cast<char>(dice.below(256));
    survive(text);
    if (HasFatalFailure()) FAIL() << "seed " << seed;
  }
}

// Pieces of the language in any order reach deeper than bytes do.
TEST(RobustnessLaws, RandomTokensDoNoHarm) {
  constexpr std::array<std::string_view, 64> kTokens{
      "G0",    "G1",      "G2",      "G3",    "G4",  "G17", "G18",  "G19",  "G20",   "G28",
      "G43H1", "G43.4H1", "G43.5H1", "G49",   "G53", "G55", "G90",  "G91",  "G93",   "G94",
      "M3",    "M6",      "M30",     "M98P1", "M99", "T1",  "S100", "F100", "F0",    "X1",
      "Y-2.5", "Z.5",     "A30",     "C-90",  "I1",  "J0",  "K1",   "R5",   "R-5",   "P2",
      "L3",    "#1=2",    "#<a>=[",  "X#1",   "X[",  "]",   "[",    "SIN[", "ATAN[", "]/[",
      ",",     "**",      " MOD ",   "-",     "(",   ")",   ";",    "%",    "/",     "O1",
      "N5",    "\n",      "\n",      "\n"};
  for (std::uint64_t seed = 1; seed <= proof::law_count(6000U, 800U); ++seed) {
    Dice dice(seed);
    std::string text;
    for (std::size_t i = dice.below(60); i > 0; --i) text += kTokens.at(dice.below(kTokens.size()));
    survive(text);
    if (HasFatalFailure()) FAIL() << "seed " << seed;
  }
}

// One wrong byte in a good program.
TEST(RobustnessLaws, MutationsDoNoHarm) {
  const std::string good =
      "%\nO1000 (PART)\nN10 G21 G90 G17 G40 G49 G80 G54\nT1 M6\nS8000 M3\n#1=[2*SIN[30]+#<a>]\n"
      "G43.4 H1 M8\nG0 X0 Y0 Z50. A-30 C90\nG1 Z5 F500\nX10 I0 J.1 K1\nG3 X20 Y0 I5\nG91 X1 Y.5 "
      "R1\n"
      "M98 P2000 L2\nG49 G90\nG53 G0 Z0\nM30\nO2000\nG91 G1 X1\nG90\nM99\n%\n";
  for (std::uint64_t seed = 1; seed <= proof::law_count(6000U, 800U); ++seed) {
    Dice dice(seed);
    std::string text = good;
    for (std::size_t i = dice.below(4) + 1; i > 0; --i) {
      const std::size_t place = dice.below(text.size());
      switch (dice.below(4)) {
        case 0:
          text[place] = static_cast<char>(dice.below(256));
          break;
        case 1:
          text.erase(place, 1 + dice.below(3));
          break;
        case 2:
          text.insert(place, text.substr(dice.below(text.size()), dice.below(12)));
          break;
        default:
          text.resize(place + 1);
          break;
      }
    }
    survive(text);
    if (HasFatalFailure()) FAIL() << "seed " << seed;
  }
}

TEST(Robustness, LongRunsOfOneCharacterDoNoHarm) {
  for (int c = 1; c < 256; ++c) {
    const std::string run(65'536, static_cast<char>(c));
    survive(run);
    survive("X" + run);
    survive("X[" + run);
    survive("#" + run);
  }
}

TEST(Robustness, NumbersAtTheEdgeOfTheRangeDoNoHarm) {
  const std::string huge = "1" + std::string(308, '0');
  survive("G1 X" + huge + " F" + huge + "\nG91 X" + huge + "\nG2 X0 I" + huge + "\n");
  survive("G20 G0 X" + huge + " Y0\nG2 X5 R" + huge + " F1\n");
  survive("G43.5 H1\nG0 X0 I" + huge + " J" + huge + "\n");
  survive("T" + huge + "\n");
  survive("G" + huge + "\n");
  survive("#" + huge + "=1\n");
}

}  // namespace
}  // namespace frustum::parser
