// G51.1, G51, G68 and G16: words that are mirrored, scaled, turned and polar.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <fmt/format.h>
#include <cmath>

#include "core/decimal.hpp"
#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

struct MirroredPlace {
  double x, y, z;
};
std::vector<MirroredPlace> places(std::string_view text) {
  std::vector<MirroredPlace> found;
  for (const Motion& motion : motions(text)) {
    const AxisTarget* end = nullptr;
    if (const auto* move = std::get_if<Traverse>(&motion.command)) end = &move->end;
    if (const auto* move = std::get_if<LinearFeed>(&motion.command)) end = &move->end;
    if (const auto* move = std::get_if<ArcFeed>(&motion.command)) end = &move->end;
    if (end != nullptr)
      found.push_back({(*end)[X].value_or(0), (*end)[Y].value_or(0), (*end)[Z].value_or(0)});
  }
  return found;
}
void expect_places(std::string_view text, const std::vector<MirroredPlace>& wanted) {
  const auto found = places(text);
  ASSERT_EQ(found.size(), wanted.size()) << text;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_NEAR(found[i].x, wanted[i].x, 1e-9) << text << i;
    EXPECT_NEAR(found[i].y, wanted[i].y, 1e-9) << text << i;
    EXPECT_NEAR(found[i].z, wanted[i].z, 1e-9) << text << i;
  }
}

TEST(Mirror, TurnsPlacesToTheOtherSide) {
  expect_places("G0 X0 Y0 Z5\nG51.1 X10\nG0 X12 Y3\nG91 X1 Y1\nG90 G50.1 X0\nG0 X12\n",
                {{0, 0, 5}, {8, 3, 5}, {7, 4, 5}, {12, 4, 5}});
  expect_places("G0 X0 Y0 Z5\nG51.1 X10 Y0\nG0 X12 Y3\nG50.1\nG0 X12\n",
                {{0, 0, 5}, {8, -3, 5}, {12, -3, 5}});
}

TEST(Mirror, CountsFromTheLocalZero) {
  expect_places("G0 X0 Y0 Z0\nG52 X100\nG51.1 X10\nG0 X12\n", {{0, 0, 0}, {108, 0, 0}});
}

TEST(Mirror, TurnsArcsRound) {
  const char* text = "G0 X20 Y0 Z0\nG51.1 X0\nG0 X20 Y0\nG2 X0 Y-20 I-20 F100\n";
  const auto arc = last_of<ArcFeed>(motions(text));
  // From (-20, 0) to (0, -20) about 0: a quarter counterclockwise.
  EXPECT_EQ(arc.turns, 1);
  EXPECT_NEAR(arc.center.norm(), 0.0, 1e-12);
  EXPECT_NEAR(*arc.end[Y], -20.0, 1e-12);
  // Two mirrored axes are half a turn; a mirrored normal leaves the plane alone.
  EXPECT_EQ(
      last_of<ArcFeed>(motions("G0 X20 Y0 Z0\nG51.1 X0 Y0\nG0 X20 Y0\nG2 X0 Y-20 I-20 F100\n"))
          .turns,
      -1);
  EXPECT_EQ(
      last_of<ArcFeed>(motions("G0 X20 Y0 Z0\nG51.1 Z0\nG0 X20 Y0\nG2 X0 Y-20 I-20 F100\n")).turns,
      -1);
}

TEST(Mirror, TurnsATurnRound) {
  // G68 within a mirrored program turns the other way, as its drawing does.
  expect_places("G0 X0 Y0 Z0\nG51.1 X0\nG68 X0 Y0 R90\nG0 X10 Y0\n", {{0, 0, 0}, {0, 10, 0}});
  expect_places("G0 X0 Y0 Z0\nG51.1 X0\nG68 X0 Y0 R30\nG0 X10 Y0\n",
                {{0, 0, 0}, {-10 * std::cos(30 * kRadPerDeg), 5, 0}});
}

TEST(Mirror, DrillsInItsPlace) {
  expect_places("G0 X0 Y0 Z5\nG51.1 X0\nG99 G81 X10 Y1 Z-3 R2 F100\nG80\n",
                {{0, 0, 5}, {-10, 1, 5}, {-10, 1, 2}, {-10, 1, -3}, {-10, 1, 2}});
}

TEST(Scaling, StretchesAboutItsCentre) {
  expect_places("G0 X0 Y0 Z0\nG51 X10 Y0 Z0 P2000\nG0 X12 Y3 Z1\nG91 X1\nG50\nG90 X12\n",
                {{0, 0, 0}, {14, 6, 2}, {16, 6, 2}, {12, 6, 2}});
  expect_places("G0 X0 Y0 Z0\nG51 X10 Y0 Z0 P0.5\nG0 X12 Y3\n", {{0, 0, 0}, {11, 1.5, 0}});
  expect_places("G0 X0 Y0 Z0\nG51 X10 Y0 Z0 I2. J2. K2.\nG0 X12 Y3\n", {{0, 0, 0}, {14, 6, 0}});
  // Without a centre: about where the tool is.
  expect_places("G0 X4 Y0 Z9\nG51 P3.\nG0 X5 Y1 Z8\n", {{4, 0, 9}, {7, 3, 6}});
}

TEST(Scaling, StretchesArcsAndTheCentreOfATurn) {
  const auto arc =
      last_of<ArcFeed>(motions("G0 X10 Y0 Z0\nG51 X0 Y0 Z0 P2.\nG0 X10 Y0\nG3 X0 Y10 I-10 F100\n"));
  EXPECT_NEAR(*arc.end[Y], 20.0, 1e-12);
  EXPECT_NEAR(arc.center.norm(), 0.0, 1e-12);
  // Centre (10, 0) becomes (20, 0); 5 to the right of it becomes 10 above it.
  expect_places("G0 X0 Y0 Z0\nG51 X0 Y0 Z0 P2.\nG68 X10 Y0 R90\nG0 X15 Y0\n",
                {{0, 0, 0}, {20, 10, 0}});
}

TEST(Rotation, TurnsInEachPlane) {
  expect_places("G0 X0 Y0 Z0\nG18 G68 X0 Z0 R90\nG0 X0 Y1 Z10\n", {{0, 0, 0}, {10, 1, 0}});
  expect_places("G0 X0 Y0 Z0\nG19 G68 Y0 Z0 R90\nG0 X1 Y10 Z0\n", {{0, 0, 0}, {1, 0, 10}});
}

// Parameter 5400#0 (RIN) = 0.
TEST(Rotation, BeginsAnewInG91Too) {
  expect_places("G0 X0 Y0 Z0\nG68 X0 Y0 R30\nG91 G68 X0 Y0 R90\nG90 G0 X10 Y0\n",
                {{0, 0, 0}, {0, 10, 0}});
  // In G90 it begins anew.
  expect_places("G0 X0 Y0 Z0\nG68 X0 Y0 R30\nG68 X0 Y0 R90\nG0 X10 Y0\n", {{0, 0, 0}, {0, 10, 0}});
  // Without a centre it turns about the tool, wherever the words before had it.
  expect_places("G0 X10 Y0 Z0\nG68 X0 Y0 R90\nG0 X10 Y0\nG68 R90\nG91 G0 X5 Y0\n",
                {{10, 0, 0}, {0, 10, 0}, {0, 15, 0}});
}

TEST(Polar, ReadsRadiusAndAngleInEachPlane) {
  expect_places("G0 X0 Y0 Z1\nG16\nG0 X10 Y90\nX20\nY180\nG15\nG0 X5 Y5\n",
                {{0, 0, 1}, {0, 10, 1}, {0, 20, 1}, {-20, 0, 1}, {5, 5, 1}});
  // ZX: Z is the radius, X the angle from Z towards X.
  expect_places("G0 X0 Y1 Z0\nG18 G16\nG0 Z10 X90\n", {{0, 1, 0}, {10, 1, 0}});
  expect_places("G0 X1 Y0 Z0\nG19 G16\nG0 Y10 Z90\n", {{1, 0, 0}, {1, 0, 10}});
}

TEST(Polar, GoesOnInG91) {
  // The radius of G90 is kept, the angle is a step: Fanuc's own example of holes on a circle.
  expect_places("G0 X0 Y0 Z0\nG90 G16 G0 X100 Y30\nG91 Y120\nY120\n",
                {{0, 0, 0},
                 {100 * std::cos(30 * kRadPerDeg), 50, 0},
                 {100 * std::cos(150 * kRadPerDeg), 50, 0},
                 {0, -100, 0}});
  // A radius in G91 counts from where the tool is.
  expect_places("G0 X5 Y5 Z0\nG16 G91 G0 X10 Y90\nX3\nY90\n",
                {{5, 5, 0}, {5, 15, 0}, {5, 18, 0}, {2, 18, 0}});
}

TEST(Polar, DrillsACircleOfHoles) {
  const auto holes = all_of<LinearFeed>(
      motions("G0 X0 Y0 Z5\nG16\nG99 G81 X10 Y0 Z-3 R2 F100\nG91 Y90 Z-5 R-3 K3\nG15 G80\n"));
  ASSERT_EQ(holes.size(), 4U);
  EXPECT_NEAR(*holes[1].end[Y], 10.0, 1e-9);
  EXPECT_NEAR(*holes[2].end[X], -10.0, 1e-9);
  EXPECT_NEAR(*holes[3].end[Y], -10.0, 1e-9);
}

TEST(Polar, TakesArcsByTheirRadius) {
  const auto arc = last_of<ArcFeed>(motions("G0 X0 Y0 Z0\nG16 G1 X10 Y0 F100\nG3 X10 Y90 R10\n"));
  EXPECT_NEAR(arc.center.norm(), 0.0, 1e-9);
  EXPECT_NEAR(*arc.end[Y], 10.0, 1e-9);
}

// A program of straight moves and arcs, with what `side` makes of X and of the sense of arcs.
std::string contour(const std::vector<int>& steps, double side, double size) {
  const auto number = [&](double value) { return shortest_decimal(value * size); };
  std::string text;
  for (const int step : steps) {
    const double x = side * (step % 7), y = step % 5 + 1.0;
    if (step % 3 == 0) {
      text += fmt::format("G91 {} X{} Y{} I{} J{}\n", (side < 0) == (step % 2 == 0) ? "G3" : "G2",
                          number(2 * x), number(2 * y), number(x), number(y));
    } else {
      text += fmt::format("G91 G1 X{} Y{}\n", number(x), number(y));
    }
  }
  return text;
}
void expect_same_motions(const std::string& left, const std::string& right) {
  const auto a = motions(left), b = motions(right);
  const auto arcs = all_of<ArcFeed>(a), other = all_of<ArcFeed>(b);
  ASSERT_EQ(arcs.size(), other.size());
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    EXPECT_EQ(arcs[i].turns, other[i].turns);
    EXPECT_LT((arcs[i].center - other[i].center).norm(), 1e-9);
  }
  const auto p = places(left), q = places(right);
  ASSERT_EQ(p.size(), q.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_NEAR(p[i].x, q[i].x, 1e-9);
    EXPECT_NEAR(p[i].y, q[i].y, 1e-9);
  }
}

RC_GTEST_PROP(MirrorLaws, AMirroredProgramIsTheProgramWithMirroredWords, ()) {
  const auto steps = *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 1000));
  const std::string start = "G0 X0 Y0 Z0 F100\n";
  expect_same_motions(start + "G51.1 X0\n" + contour(steps, 1, 1), start + contour(steps, -1, 1));
}
RC_GTEST_PROP(ScalingLaws, AScaledProgramIsTheProgramWithScaledWords, ()) {
  const auto steps = *rc::gen::container<std::vector<int>>(rc::gen::inRange(1, 1000));
  const std::string start = "G0 X0 Y0 Z0 F100\n";
  expect_same_motions(start + "G51 X0 Y0 Z0 P2500\n" + contour(steps, 1, 1),
                      start + contour(steps, 1, 2.5));
}

}  // namespace
}  // namespace frustum::parser
