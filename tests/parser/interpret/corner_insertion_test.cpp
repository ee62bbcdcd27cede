// RND and CHF of Klartext: corners between lines and arcs, derived by hand, and where they do not
// fit.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "parser/tool_table.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run(const std::string& text, const InterpreterOptions& options = {}) {
  return motions(text, options, Dialect::heidenhain);
}
// "rapid 0 0", "line 5 0 F100", "arc 10 5 about 5 5 F20 +1" for each move.
std::vector<std::string> moves(const std::vector<Motion>& all) {
  std::vector<std::string> found;
  const auto zero = [](double value) { return std::abs(value) < 1e-9 ? 0.0 : value; };
  for (const Motion& motion : all) {
    if (const auto* rapid = std::get_if<Traverse>(&motion.command)) {
      found.push_back(fmt::format("rapid {:.6g} {:.6g}", *rapid->end[X], *rapid->end[Y]));
    } else if (const auto* line = std::get_if<LinearFeed>(&motion.command)) {
      found.push_back(fmt::format("line {:.6g} {:.6g} F{:g}", zero(*line->end[X]),
                                  zero(*line->end[Y]), line->feed.value));
    } else if (const auto* arc = std::get_if<ArcFeed>(&motion.command)) {
      found.push_back(fmt::format("arc {:.6g} {:.6g} about {:.6g} {:.6g} F{:g} {:+d}",
                                  zero(*arc->end[X]), zero(*arc->end[Y]), zero(arc->center[0]),
                                  zero(arc->center[1]), arc->feed.value, arc->turns));
    }
  }
  return found;
}
using Moves = std::vector<std::string>;

TEST(Corners, AreRoundedBetweenLines) {
  EXPECT_EQ(moves(run("L X+0 Y+0 FMAX\nL X+10 F100\nRND R2 F50\nL Y+10 M3\nL X+0\n")),
            (Moves{"rapid 0 0", "line 8 0 F100", "arc 10 2 about 8 2 F50 +1", "line 10 10 F100",
                   "line 0 10 F100"}));
  // To the right, in one rounding after another; the second move is short of the first rounding.
  EXPECT_EQ(moves(run("L X+0 Y+0 FMAX\nL X+10 F100\nRND R3\nL Y-10\nRND R6\nL X+0\n")),
            (Moves{"rapid 0 0", "line 7 0 F100", "arc 10 -3 about 7 -3 F100 -1", "line 10 -4 F100",
                   "arc 4 -10 about 4 -4 F100 -1", "line 0 -10 F100"}));
}

TEST(Corners, AreBrokenBetweenLines) {
  EXPECT_EQ(moves(run("Q1 = 2\nL X+0 Y+0 FMAX\nL X+10 F100\nCHF Q1 F30\n; next\nL X+16 Y+8\n")),
            (Moves{"rapid 0 0", "line 8 0 F100", "line 11.2 1.6 F30", "line 16 8 F100"}));
}

TEST(Corners, AreRoundedBesideArcs) {
  // From the line along X into the circle of 10 about (20 0), clockwise up from its left-hand
  // point.
  const auto all =
      run("L X+0 Y+0 FMAX\nL X+10 F100\nRND R2\nCC X+20 Y+0\nC X+30 Y+0 DR-\nL X+40\n");
  const auto arcs = all_of<ArcFeed>(all);
  ASSERT_EQ(arcs.size(), 2U);
  const ArcFeed& rounding = arcs[0];
  const LinearFeed before = all_of<LinearFeed>(all)[0];
  // 2 above the line, 12 from the circle's centre.
  const double x = 20 - std::sqrt(144.0 - 4.0);
  EXPECT_NEAR(rounding.center[0], x, 1e-9);
  EXPECT_NEAR(rounding.center[1], 2.0, 1e-9);
  EXPECT_NEAR(*before.end[X], x, 1e-9);
  EXPECT_NEAR(*rounding.end[X], 20 + (x - 20) * 10 / 12, 1e-9);
  EXPECT_NEAR(*rounding.end[Y], 2.0 * 10 / 12, 1e-9);
  EXPECT_EQ(rounding.turns, 1);
  EXPECT_EQ(arcs[1].end[X], 30.0);
  EXPECT_EQ(arcs[1].turns, -1);
}

// Both ends touch their moves: the way turns nowhere by a jump.
TEST(CornerLaws, ARoundedContourHasNoCorner) {
  for (int degrees = -170; degrees <= 170; degrees += 7) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const double radius = 1.5;
    const auto all =
        run(fmt::format("L X+0 Y+0 FMAX\nL X+100 F100\nRND R{}\nL IX{:+.9f} IY{:+.9f}\n", radius,
                        80 * std::cos(angle), 80 * std::sin(angle)));
    const auto arcs = all_of<ArcFeed>(all);
    ASSERT_EQ(arcs.size(), 1U) << degrees;
    const double lost = radius * std::tan(std::abs(angle) / 2);
    EXPECT_NEAR(*all_of<LinearFeed>(all)[0].end[X], 100 - lost, 1e-7) << degrees;
    EXPECT_NEAR(*arcs[0].end[X], 100 + lost * std::cos(angle), 1e-7) << degrees;
    EXPECT_NEAR(*arcs[0].end[Y], lost * std::sin(angle), 1e-7) << degrees;
    EXPECT_NEAR(arcs[0].center[1], degrees > 0 ? radius : -radius, 1e-7) << degrees;
  }
}

// The corner belongs to the contour, and the tool's centre goes beside it.
TEST(Corners, AreThoseOfTheContourUnderRadiusCompensation) {
  InterpreterOptions options;
  options.tools[1].diameter = 2.0;
  const auto all =
      run("TOOL CALL 1 Z S100\nL X-10 Y-5 Z+0 R0 FMAX M3\nL X+0 Y+0 RL F100\nL X+20 RL\nRND R5\n"
          "L Y+20 RL\nL X+0\nL X-10 Y+30 R0\n",
          options);
  const auto arcs = all_of<ArcFeed>(all);
  ASSERT_GE(arcs.size(), 1U);
  // A rounding of 5 on the inside is one of 4 for the centre of a tool of radius 1.
  EXPECT_NEAR(arcs[0].center[0], 15.0, 1e-9);
  EXPECT_NEAR(arcs[0].center[1], 5.0, 1e-9);
  EXPECT_NEAR(*arcs[0].end[X], 19.0, 1e-9);
  EXPECT_NEAR(*arcs[0].end[Y], 5.0, 1e-9);
}

TEST(Corners, KeepTheMotionsBeforeAMistake) {
  const auto program =
      parse_program("L X+0 Y+0 FMAX\nL X+10 F100\nCALL LBL 9\n", "part.h", Dialect::heidenhain);
  ASSERT_TRUE(program);
  int count = 0;
  EXPECT_FALSE(interpret(*program, [&count](Motion&&) { ++count; }));
  EXPECT_EQ(count, 2);
}

struct WrongCorner {
  const char* text;
  const char* complaint;
};

TEST(CornerErrors, SayWhereWhatAndTheRemedy) {
  const std::string start = "L X+0 Y+0 Z+0 FMAX\nL X+10 F100\n";
  const WrongCorner mistakes[] = {
      {"RND R2\n", "3:1: error: RND with no move after it"},
      {"RND R2\nEND PGM A MM\n", "4:1: error: END PGM between RND and the move after it"},
      {"RND R2\nL Y+10 FMAX\n", "3:1: error: RND before no cutting move in the plane"},
      {"RND R2\nL Y+10 Z-1\n", "3:1: error: RND before no cutting move in the plane"},
      {"RND R2\nRND R2\n", "4:1: error: RND after RND"},
      {"RND R2\nCYCL DEF 7.1 X+1\n", "4:1: error: CYCL DEF 7 between RND and the move after it"},
      {"L Y+5 FMAX\nRND R2\n", "4:1: error: RND after no cutting move in the plane"},
      {"L Z-5\nCHF 2\n", "4:1: error: CHF after no cutting move in the plane"},
      {"RND R2\nL X+20\n", "3:1: error: RND where the moves lead on without a corner"},
      {"RND R2\nL X+5\n", "3:1: error: RND where the moves go straight back"},
      {"RND R12\nL Y+50\n", "3:1: error: RND takes 12 mm of the 10 mm of the move before it"},
      {"RND R8\nL Y+5\n", "3:1: error: RND takes 8 mm of the 5 mm of the move after it"},
      {"CHF 12\nL Y+50\n", "3:1: error: CHF takes 12 mm of the 10 mm of the move before it"},
      {"CHF 2\nCC X+10 Y+10\nC X+10 Y+20 DR+\n", "3:1: error: CHF where the moves lead on"},
      {"CHF 2\nCC X+20 Y+0\nC X+30 Y+0 DR-\n", "3:1: error: CHF at an arc"},
      {"RND R20\nCC X+10 Y+3\nC X+10 Y+6 DR+\n", "3:1: error: RND "},
      {"RND R0\n", "3:5: error: the size of RND is not above zero"},
      {"CHF -2\n", "3:5: error: the size of CHF is not above zero"},
      {"RND R2 F0\n", "3:8: error: F0 is not above zero"},
      {"RND 2\n", "3:5: error: RND has no radius"},
      {"RND R\n", "3:5: error: R has no number"},
      {"RND R2 FMAX\n", "3:8: error: the feed of RND is no number"},
      {"RND R2 X+5\n", "3:8: error: unexpected 'X'"},
      {"CHF 2\nL Y+10 FT5\n", "3:1: error: CHF beside a move with FT"},
  };
  for (const WrongCorner& wrong : mistakes) {
    const auto lines = complaints(start + wrong.text, {}, Dialect::heidenhain);
    ASSERT_EQ(lines.size(), 1U) << wrong.text;
    EXPECT_TRUE(lines[0].starts_with(wrong.complaint)) << lines[0] << "\n" << wrong.text;
    EXPECT_NE(lines[0].find(" (hint: "), std::string::npos) << lines[0];
  }
}

}  // namespace
}  // namespace frustum::parser
