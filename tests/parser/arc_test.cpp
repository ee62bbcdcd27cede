#include "parser/arc.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <ostream>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

// One cell of the matrix plane x direction x helix: a quarter turn of radius 10 about a centre that
// is not the origin, written out by hand from ISO 6983's definition (clockwise seen against the
// normal).
struct Cell {
  const char* name;
  const char* text;
  Plane plane;
  int turns;
  Vec3 centre;
  Vec3 end;
};

const std::array kMatrix{
    Cell{
        "G17_G2", "G17 G0 X15 Y5 Z2\nG2 X5 Y-5 I-10 J0 F100", Plane::xy, -1, {5, 5, 2}, {5, -5, 2}},
    Cell{"G17_G3", "G17 G0 X15 Y5 Z2\nG3 X5 Y15 I-10 J0 F100", Plane::xy, 1, {5, 5, 2}, {5, 15, 2}},
    Cell{"G17_G2_helix",
         "G17 G0 X15 Y5 Z2\nG2 X5 Y-5 Z-4 I-10 F100",
         Plane::xy,
         -1,
         {5, 5, 2},
         {5, -5, -4}},
    Cell{"G17_G3_helix",
         "G17 G0 X15 Y5 Z2\nG3 X5 Y15 Z-4 I-10 F100",
         Plane::xy,
         1,
         {5, 5, 2},
         {5, 15, -4}},
    Cell{
        "G18_G2", "G18 G0 Z15 X5 Y2\nG2 Z5 X-5 K-10 I0 F100", Plane::zx, -1, {5, 2, 5}, {-5, 2, 5}},
    Cell{"G18_G3", "G18 G0 Z15 X5 Y2\nG3 Z5 X15 K-10 I0 F100", Plane::zx, 1, {5, 2, 5}, {15, 2, 5}},
    Cell{"G18_G2_helix",
         "G18 G0 Z15 X5 Y2\nG2 Z5 X-5 Y8 K-10 F100",
         Plane::zx,
         -1,
         {5, 2, 5},
         {-5, 8, 5}},
    Cell{"G18_G3_helix",
         "G18 G0 Z15 X5 Y2\nG3 Z5 X15 Y8 K-10 F100",
         Plane::zx,
         1,
         {5, 2, 5},
         {15, 8, 5}},
    Cell{
        "G19_G2", "G19 G0 Y15 Z5 X2\nG2 Y5 Z-5 J-10 K0 F100", Plane::yz, -1, {2, 5, 5}, {2, 5, -5}},
    Cell{"G19_G3", "G19 G0 Y15 Z5 X2\nG3 Y5 Z15 J-10 K0 F100", Plane::yz, 1, {2, 5, 5}, {2, 5, 15}},
    Cell{"G19_G2_helix",
         "G19 G0 Y15 Z5 X2\nG2 Y5 Z-5 X7 J-10 F100",
         Plane::yz,
         -1,
         {2, 5, 5},
         {7, 5, -5}},
    Cell{"G19_G3_helix",
         "G19 G0 Y15 Z5 X2\nG3 Y5 Z15 X7 J-10 F100",
         Plane::yz,
         1,
         {2, 5, 5},
         {7, 5, 15}},
};

Vec3 point_of(const AxisTarget& target) {
  return {*target[AxisLetter::X], *target[AxisLetter::Y], *target[AxisLetter::Z]};
}

// Names the cell in the list of tests.
void PrintTo(const Cell& cell, std::ostream* out) {  // NOLINT: GoogleTest's spelling
  *out << cell.name;
}

class Complaint14ArcMatrix : public testing::TestWithParam<Cell> {};

TEST_P(Complaint14ArcMatrix, HasThePlaneTurnCentreAndEndOfTheProgram) {
  const auto arc = last_of<ArcFeed>(motions(GetParam().text));
  EXPECT_EQ(arc.plane, GetParam().plane);
  EXPECT_EQ(arc.turns, GetParam().turns);
  EXPECT_EQ(arc.center, GetParam().centre) << arc.center.transpose();
  EXPECT_EQ(point_of(arc.end), GetParam().end);
}

// The same arc by its radius: R+ is the quarter that the matrix means.
TEST_P(Complaint14ArcMatrix, HasTheSameCentreByRadius) {
  std::string text = GetParam().text;
  const std::size_t first = text.find_first_of("IJK", text.find('\n'));
  text.replace(first, text.find(" F100") - first, "R10");
  const auto arc = last_of<ArcFeed>(motions(text));
  EXPECT_EQ(arc.turns, GetParam().turns);
  EXPECT_LT((arc.center - GetParam().centre).norm(), 1e-12) << arc.center.transpose();
}

// R- is the other way about: three quarters, with the centre mirrored at the chord.
TEST_P(Complaint14ArcMatrix, HasTheMirroredCentreByNegativeRadius) {
  std::string text = GetParam().text;
  const std::size_t first = text.find_first_of("IJK", text.find('\n'));
  text.replace(first, text.find(" F100") - first, "R-10");
  const auto arc = last_of<ArcFeed>(motions(text));
  const PlaneAxes axes = axes_of(GetParam().plane);
  const auto start = point_of(last_of<Traverse>(motions(text)).end);
  Vec3 mirrored = start + GetParam().end - GetParam().centre;
  mirrored[axes.w] = start[axes.w];
  EXPECT_EQ(arc.turns, GetParam().turns);
  EXPECT_LT((arc.center - mirrored).norm(), 1e-12) << arc.center.transpose();
}

INSTANTIATE_TEST_SUITE_P(Cells, Complaint14ArcMatrix, testing::ValuesIn(kMatrix),
                         [](const auto& cell) { return std::string(cell.param.name); });

TEST(Complaint14, HelixReachesItsWholeHeight) {
  const auto arc = last_of<ArcFeed>(motions("G0 X10 Y0 Z0\nG3 X10 Y0 Z-9 I-10 P3 F100\n"));
  EXPECT_EQ(arc.turns, 3);
  EXPECT_EQ(point_of(arc.end), Vec3(10, 0, -9));
  EXPECT_EQ(arc.center, Vec3(0, 0, 0));
}

TEST(Complaint14, ThePlaneWordOfTheSameBlockCounts) {
  const auto arc = last_of<ArcFeed>(motions("G17 G0 X10 Y0 Z0\nG18 G2 X0 Z-10 I-10 F100\n"));
  EXPECT_EQ(arc.plane, Plane::zx);
}

TEST(Arc, OfCentreWordsAloneIsAFullCircle) {
  for (const char* words : {"I-10", "X10 I-10", "X10 Y0 I-10 J0"}) {
    const auto arc = last_of<ArcFeed>(motions(fmt::format("G0 X10 Y0 Z3\nG2 {} F100\n", words)));
    EXPECT_EQ(arc.turns, -1);
    EXPECT_EQ(arc.center, Vec3(0, 0, 3));
    EXPECT_EQ(point_of(arc.end), Vec3(10, 0, 3));
  }
}

TEST(Arc, OfAnEndWithinOneNanometreOfItsStartIsAFullCircle) {
  const auto arc = last_of<ArcFeed>(motions("G0 X10 Y0 Z3\nG2 X10.0000001 Y0 I-10 F100\n"));
  EXPECT_EQ(*arc.end[AxisLetter::X], 10.0);
}

TEST(Arc, TakesAbsoluteCentresAfterG90Point1) {
  const auto arc = last_of<ArcFeed>(motions("G90.1 G0 X15 Y5 Z0\nG3 X5 Y15 I5 J5 F100\n"));
  EXPECT_EQ(arc.center, Vec3(5, 5, 0));
  const auto back = last_of<ArcFeed>(motions("G90.1\nG91.1 G0 X15 Y5\nG3 X5 Y15 I-10 J0 F100\n"));
  EXPECT_EQ(back.center, Vec3(5, 5, 0));
}

TEST(Arc, TakesIncrementalEnds) {
  const auto arc = last_of<ArcFeed>(motions("G0 X15 Y5 Z1\nG91 G3 X-10 Y10 I-10 F100\n"));
  EXPECT_EQ(point_of(arc.end), Vec3(5, 15, 1));
}

TEST(Arc, TurnsRotaryAxesAlong) {
  const auto arc = last_of<ArcFeed>(motions("G0 X10 Y0 Z0 C0\nG3 X-10 I-10 C180 F100\n"));
  EXPECT_DOUBLE_EQ(*arc.end[AxisLetter::C], std::numbers::pi);
}

TEST(Arc, WithoutAKnownHeightHasNoHeight) {
  const auto arc = last_of<ArcFeed>(motions("G0 X10 Y0\nG3 X-10 I-10 F100\n"));
  EXPECT_FALSE(arc.end[AxisLetter::Z].has_value());
  EXPECT_EQ(arc.center, Vec3(0, 0, 0));
}

// RS-274: radii may differ by 0.01 mm, or by 0.1 % where that is more, but never by over 0.5 mm.
TEST(Arc, ForgivesTheRoundingOfPostProcessors) {
  struct Case {
    double radius;
    double difference;
    bool forgiven;
  };
  for (const Case& c : {Case{5, 0.0099, true}, Case{5, 0.0102, false}, Case{100, 0.099, true},
                        Case{100, 0.102, false}, Case{2000, 0.49, true}, Case{2000, 0.51, false}}) {
    ArcWords words;
    words.end = Vec3(2 * c.radius + c.difference, 0, 0);
    words.centre = {c.radius, std::nullopt, std::nullopt};
    EXPECT_EQ(arc_of(words).has_value(), c.forgiven) << c.radius << " " << c.difference;
  }
}

TEST(Arc, BySmallRadiusWithinRoundingIsASemicircle) {
  const auto arc = last_of<ArcFeed>(motions("G0 X0 Y0 Z0\nG2 X10 R4.999 F100\n"));
  EXPECT_LT((arc.center - Vec3(5, 0, 0)).norm(), 1e-12);
}

// Law: an arc given by centre and the same arc given by signed radius have one centre.
TEST(ArcLaws, CentreAndRadiusAgreeForAllSweeps) {
  for (const Plane plane : {Plane::xy, Plane::zx, Plane::yz}) {
    const PlaneAxes axes = axes_of(plane);
    for (const bool clockwise : {false, true}) {
      for (int degrees = 5; degrees < 360; degrees += 5) {
        // At half a turn the sign of the radius says nothing and rounding picks either side.
        if (degrees == 180) continue;
        const double sweep = (clockwise ? -1.0 : 1.0) * degrees * std::numbers::pi / 180.0;
        const double radius = 7.5;
        ArcWords words;
        words.plane = plane;
        words.clockwise = clockwise;
        words.start[axes.u] = radius * std::cos(1.0);
        words.start[axes.v] = radius * std::sin(1.0);
        words.end[axes.u] = radius * std::cos(1.0 + sweep);
        words.end[axes.v] = radius * std::sin(1.0 + sweep);
        words.radius = degrees < 180 ? radius : -radius;
        const auto arc = arc_of(words);
        ASSERT_TRUE(arc);
        // The centre is the origin; near half a turn it is ill-conditioned by 1 / cos(sweep / 2).
        EXPECT_LT(arc->centre.norm(), 1e-12 / std::abs(std::cos(sweep / 2))) << degrees;
      }
    }
  }
}

}  // namespace
}  // namespace frustum::parser
