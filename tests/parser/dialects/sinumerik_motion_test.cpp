// Rotary words and directions of Sinumerik, places about a pole, arcs through a point and
// tangential ones, threads.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

using enum AxisLetter;

std::vector<Motion> run_sinumerik(std::string_view text) {
  return motions(text, {}, Dialect::sinumerik);
}

std::vector<RotaryPathChange> paths_of(std::string_view text) {
  return all_of<RotaryPathChange>(run_sinumerik(text));
}

TEST(SinumerikRotary, TurnsInTheDirectionThatAWordAsksFor) {
  const auto up = paths_of("G0 C=ACP(10)\n");
  ASSERT_EQ(up.size(), 1U);
  EXPECT_EQ(up[0].path, RotaryPath::positive);
  EXPECT_EQ(up[0].axes, (std::array{false, false, true}));
  EXPECT_DOUBLE_EQ(*last_of<Traverse>(run_sinumerik("G0 C=ACP(10)\n")).end[C], 10 * kRadPerDeg);
  EXPECT_EQ(paths_of("G0 B=ACN(10)\n").at(0).path, RotaryPath::negative);
  // Each axis has its own way; equal ones are reported together.
  const auto both = paths_of("G0 A=DC(1) B=ACP(2) C=DC(3)\n");
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].path, RotaryPath::shortest);
  EXPECT_EQ(both[0].axes, (std::array{true, false, true}));
  EXPECT_EQ(both[1].axes, (std::array{false, true, false}));
  // A value without a way turns to that value again.
  EXPECT_EQ(paths_of("G0 C=ACP(10)\nC=AC(20)\n").at(1).path, RotaryPath::as_programmed);
  EXPECT_EQ(paths_of("G0 C=ACP(10)\nC=ACP(20)\n").size(), 1U);
  // The full turns are not known any more.
  EXPECT_FALSE(last_of<Traverse>(run_sinumerik("G0 C=ACN(10)\nX1\n")).end[C].has_value());
}

TEST(SinumerikRotary, StepsGoOnFromWhereTheAxisIs) {
  const auto last_path = [](const std::string& step) {
    return paths_of("G0 C=ACP(10)\nC5\nC=DC(350)\n" + step).back().path;
  };
  EXPECT_EQ(last_path("C=IC(-180)\n"), RotaryPath::shortest);
  EXPECT_EQ(last_path("C=IC(270)\n"), RotaryPath::positive);
  EXPECT_EQ(last_path("G91 C-270\n"), RotaryPath::negative);
  EXPECT_EQ(last_path("G91 C20\n"), RotaryPath::shortest);
  EXPECT_DOUBLE_EQ(*last_of<Traverse>(run_sinumerik("G0 C=DC(350)\nG91 C270\n")).end[C],
                   620 * kRadPerDeg);
}

TEST(SinumerikRotary, FullTurnsCountFromTheLastWord) {
  const auto moves = run_sinumerik("G0 X0 C=DC(10)\nG91 G1 C-360.1 F100\n");
  EXPECT_NEAR(*last_of<LinearFeed>(moves).end[C], -350.1 * kRadPerDeg, 1e-12);
  EXPECT_EQ(all_of<RotaryPathChange>(moves).back().path, RotaryPath::as_programmed);
  ASSERT_EQ(all_of<Event>(moves).size(), 1U);
  EXPECT_EQ(all_of<Event>(moves)[0].grade, EventGrade::assumed);
}

TEST(SinumerikOrientation, OfTheMachineIsThatOfTheWordsWhileNoFrameTurnsThem) {
  const std::string head = "T1 D1 M6\nTRAORI\nG0 X0 Y0 Z0\n";
  const std::string vector = "G1 X5 A3=0.6 B3=0 C3=0.8 F100\n";
  const auto without = run_sinumerik(head + vector);
  for (const char* frame : {"", "TRANS X10\n", "ATRANS Z5\n", "G55\n"}) {
    const auto all = run_sinumerik(head + "ORIMKS\n" + frame + vector);
    EXPECT_EQ(last_of<LinearFeed>(all).tool_axis->vec(),
              last_of<LinearFeed>(without).tool_axis->vec());
    EXPECT_TRUE(all_of<OrientationPathChange>(all).empty());
  }
  // Told, not silent; the workpiece's frame comes back.
  const auto told = all_of<Event>(run_sinumerik("ORIMKS\nORIWKS\n"));
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].name, "ORIMKS");
  EXPECT_EQ(told[1].name, "ORIWKS");
  EXPECT_TRUE(run_sinumerik(head + "ORIMKS\nORIWKS\nROT Z30\nG0 X0 Y0 Z0\nA3=0 C3=1\n").size() > 5);
  // Rotary words are of the machine in any frame.
  EXPECT_DOUBLE_EQ(
      *last_of<Traverse>(run_sinumerik(head + "ORIMKS\nROT Z30\nG0 X0 Y0 Z0 B5\n")).end[B],
      5 * kRadPerDeg);
}

// --- Polar positions -----------------------------------------------------------------------------

Vec3 place(const AxisTarget& end) {
  return {end[X].value_or(1e9), end[Y].value_or(1e9), end[Z].value_or(1e9)};
}

void expect_end(const std::string& text, double x, double y, double z) {
  const Vec3 end = place(last_of<Traverse>(run_sinumerik(text)).end);
  EXPECT_LT((end - Vec3(x, y, z)).norm(), 1e-9) << text << end.transpose();
}

TEST(SinumerikPolar, CountsFromThePole) {
  const double c = std::sqrt(3.0) / 2.0;
  expect_end("G0 X0 Y0 Z5\nG111 X40 Y33\nG0 AP=30 RP=10\n", 40 + 10 * c, 38, 5);
  // From where the tool is, from the last pole, by radius and angle.
  expect_end("G0 X1 Y2 Z5\nG110 X10 Y20\nG0 AP=90 RP=10\n", 11, 32, 5);
  expect_end("G0 X1 Y2 Z5\nG110 X10\nG0 AP=90 RP=10\n", 11, 12, 5);
  expect_end("G0 X1 Y2 Z5\nG111 X10 Y20\nG112 X1 Y-1\nG0 AP=180 RP=3\n", 8, 19, 5);
  expect_end("G0 X1 Y2 Z5\nG111 RP=10 AP=90\nG0 AP=0 RP=3\n", 3, 10, 5);
  // Without a pole: the origin, of the frame at work.
  expect_end("G0 X1 Y2 Z5\nG0 AP=90 RP=3\n", 0, 3, 5);
  expect_end("TRANS X10\nG0 X1 Y2 Z5\nG0 AP=90 RP=3\n", 10, 3, 5);
  expect_end("G0 X1 Y2 Z5\nAP=90 RP=3\nTRANS X10\nX0 Y0 Z0\nAP=90 RP=3\n", 10, 3, 0);
  expect_end("G700 G0 X0 Y0 Z0\nG111 X1 Y0\nG0 AP=0 RP=1\n", 50.8, 0, 0);
  // G91 leaves poles as they are.
  expect_end("G0 X1 Y2 Z5\nG91 G111 X10 Y20\nG90 G0 AP=0 RP=1\n", 11, 20, 5);
  // A pole stays where it is while the axes go elsewhere.
  expect_end("G0 X0 Y0 Z0\nG111 X5 Y5\nG0 SUPA D0 X1 Y1\nG0 AP=0 RP=1 Z2\n", 6, 5, 2);
}

TEST(SinumerikPolar, LiesInThePlane) {
  expect_end("G18 G0 X0 Y7 Z0\nG111 Z10 X20\nG0 AP=90 RP=5\n", 25, 7, 10);
  expect_end("G19 G0 X7 Y0 Z0\nG111 Y10 Z20\nG0 AP=90 RP=5\n", 7, 10, 25);
}

TEST(SinumerikPolar, KeepsWhatIsLeftOut) {
  const std::string start = "G0 X0 Y0 Z0\nG111 X10 Y10\nG0 AP=0 RP=5\n";
  expect_end(start + "AP=90\n", 10, 15, 0);
  expect_end(start + "RP=7\n", 17, 10, 0);
  expect_end(start + "AP=IC(90)\nAP=IC(90)\n", 5, 10, 0);
  expect_end(start + "RP=IC(2) AP=180\n", 3, 10, 0);
  expect_end(start + "G91 AP=90\n", 10, 15, 0);
  expect_end(start + "G91 AP=AC(180) RP=AC(1)\n", 9, 10, 0);
  // At the pole the last angle counts.
  expect_end(start + "AP=90 RP=0\nRP=4\n", 10, 14, 0);
  // The radius of the place, before any has been written.
  expect_end("G0 X3 Y4 Z0\nG0 AP=0\n", 5, 0, 0);
}

TEST(SinumerikPolar, TurnsAboutThePole) {
  const ArcFeed arc = last_of<ArcFeed>(
      run_sinumerik("N5 G17 G90 G0 X30 Y40 F100\nN10 G111 X40 Y33\nG2 RP=12.207 AP=21\n"));
  EXPECT_LT((arc.center - Vec3(40, 33, 0)).norm(), 1e-12);
  EXPECT_EQ(arc.turns, -1);
  EXPECT_NEAR(*arc.end[X], 40 + 12.207 * std::cos(21 * kRadPerDeg), 1e-9);
  const ArcFeed helix = last_of<ArcFeed>(
      run_sinumerik("G0 X15 Y10 Z0 F100\nG111 X10 Y10\nG0 AP=0 RP=5\nG3 AP=90 Z-4 TURN=2\n"));
  EXPECT_EQ(helix.turns, 3);
  EXPECT_LT((place(helix.end) - Vec3(10, 15, -4)).norm(), 1e-9);
  EXPECT_EQ(
      last_of<ArcFeed>(run_sinumerik("G0 X15 Y10 Z0 F100\nG111 X10 Y10\nG3 AP=AC(-90) RP=5\n"))
          .turns,
      1);
}

RC_GTEST_PROP(SinumerikPolarLaws, PositionsAreComplexNumbers, ()) {
  using Complex = std::complex<double>;
  const auto number = [](int from, int to) {
    return static_cast<double>(*rc::gen::inRange(from * 10, to * 10)) / 10.0;
  };
  const auto polar = [](double radius, double degrees) {
    return std::polar(radius, degrees * kRadPerDeg);
  };
  Complex here(number(-50, 50), number(-50, 50));
  Complex pole = 0;
  std::string text = fmt::format("G0 X{} Y{} Z0\n", here.real(), here.imag());
  double radius = 0.0;
  double angle = 0.0;
  bool written = false;  // about this pole
  const int count = *rc::gen::inRange(1, 12);
  for (int i = 0; i < count; ++i) {
    const int kind = *rc::gen::inRange(0, 6);
    const double a = number(-400, 400);
    const double r = number(1, 60);
    if (kind < 3) {
      const Complex to(number(-50, 50), number(-50, 50));
      const Complex base = kind == 0 ? here : kind == 1 ? Complex(0) : pole;
      const bool by_angle = *rc::gen::arbitrary<bool>();
      pole = base + (by_angle ? polar(r, a) : to);
      text += fmt::format("G11{} ", kind);
      text += by_angle ? fmt::format("AP={} RP={}\n", a, r)
                       : fmt::format("X{} Y{}\n", to.real(), to.imag());
      written = false;
    } else if (kind == 3 || !written) {
      text += fmt::format("G0 AP={} RP={}\n", a, r);
      radius = r;
      angle = a;
      written = true;
    } else if (kind == 4) {
      text += fmt::format("G0 AP=IC({})\n", a);
      angle += a;
    } else {
      text += fmt::format("G0 RP={}\n", r);
      radius = r;
    }
    if (kind >= 3) here = pole + polar(radius, angle);
  }
  const AxisTarget end = last_of<Traverse>(run_sinumerik(text)).end;
  RC_ASSERT(std::abs(Complex(*end[X], *end[Y]) - here) < 1e-9);
}

// --- Arcs through a point, tangential arcs -------------------------------------------------------

TEST(SinumerikArcs, GoThroughTheirPoint) {
  const ArcFeed arc = last_of<ArcFeed>(run_sinumerik("G0 X30 Y40 F100\nCIP X50 Y40 I1=40 J1=45\n"));
  EXPECT_LT((arc.center - Vec3(40, 32.5, 0)).norm(), 1e-9);
  EXPECT_EQ(arc.turns, -1);
  EXPECT_EQ(arc.plane, Plane::xy);
  const ArcFeed back =
      last_of<ArcFeed>(run_sinumerik("G0 X30 Y40 F100\nCIP X50 Y40 I1=40 J1=20\n"));
  EXPECT_EQ(back.turns, 1);
  // Steps count from the start, both of the end and of the point.
  const ArcFeed steps =
      last_of<ArcFeed>(run_sinumerik("G0 X30 Y40 F100\nG91 CIP X20 Y0 I1=10 J1=5\n"));
  EXPECT_LT((steps.center - Vec3(40, 32.5, 0)).norm(), 1e-9);
  const ArcFeed mixed =
      last_of<ArcFeed>(run_sinumerik("G0 X30 Y40 F100\nCIP X=IC(20) Y40 I1=IC(10) J1=AC(45)\n"));
  EXPECT_LT((mixed.center - Vec3(40, 32.5, 0)).norm(), 1e-9);
  // It stays in force.
  EXPECT_EQ(
      all_of<ArcFeed>(run_sinumerik("G0 X0 Y0 F100\nCIP X10 Y0 I1=5 J1=5\nX0 Y0 I1=5 J1=-5\n"))
          .size(),
      2U);
  // In another plane of two axes than that in force.
  const ArcFeed side =
      last_of<ArcFeed>(run_sinumerik("G0 X30 Y2 Z40 F100\nCIP X50 Y2 Z40 I1=40 J1=2 K1=45\n"));
  EXPECT_EQ(side.plane, Plane::zx);
  EXPECT_LT((side.center - Vec3(40, 2, 32.5)).norm(), 1e-9);
  EXPECT_EQ(side.turns, 1);  // from -X over +Z to +X, seen from +Y: counterclockwise
}

RC_GTEST_PROP(SinumerikArcLaws, ArcsThroughAPointStayOnTheirCircle, ()) {
  const auto number = [](int from, int to) {
    return static_cast<double>(*rc::gen::inRange(from * 100, to * 100)) / 100.0;
  };
  const Vec3 centre(number(-50, 50), number(-50, 50), number(-50, 50));
  const double radius = number(1, 40);
  Vec3 normal(number(-9, 9), number(-9, 9), number(-9, 9));
  RC_PRE(normal.norm() > 0.5);
  normal.normalize();
  const Vec3 u = normal.unitOrthogonal();
  const Vec3 v = normal.cross(u);
  const double first = number(0, 6);
  const double to_between = number(0, 3) + 0.1;
  const double to_end = to_between + number(0, 3) + 0.05;
  const auto at = [&](double angle) -> Vec3 {
    return centre + radius * (std::cos(angle) * u + std::sin(angle) * v);
  };
  const Vec3 start = at(first);
  const Vec3 between = at(first + to_between);
  const Vec3 end = at(first + to_end);
  const auto all = run_sinumerik(fmt::format(
      "G0 X={:.12f} Y={:.12f} Z={:.12f} F100\nCIP X={:.12f} Y={:.12f} Z={:.12f} I1={:.12f} "
      "J1={:.12f} K1={:.12f}\n",
      start.x(), start.y(), start.z(), end.x(), end.y(), end.z(), between.x(), between.y(),
      between.z()));
  const auto lines = all_of<LinearFeed>(all);
  RC_PRE(!lines.empty());  // else the circle is in a plane of two axes
  double nearest = 1e9;
  Vec3 last = start;
  double turned = 0.0;
  for (const LinearFeed& line : lines) {
    const Vec3 point = place(line.end);
    RC_ASSERT(std::abs((point - centre).norm() - radius) < 1e-6);
    RC_ASSERT(std::abs((point - centre).dot(normal)) < 1e-6);
    // The middle of the chord is where it is farthest from the arc.
    RC_ASSERT(radius - ((point + last) / 2.0 - centre).norm() < 1.01e-4);
    turned += std::asin(
        std::min(1.0, normal.dot((last - centre).cross(point - centre)) / (radius * radius)));
    const double share =
        std::clamp((between - last).dot(point - last) / (point - last).squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (last + share * (point - last) - between).norm());
    last = point;
  }
  RC_ASSERT(nearest < 1.01e-4);
  RC_ASSERT((last - end).norm() < 1e-9);
  RC_ASSERT(std::abs(turned - to_end) < 1e-5);
  RC_ASSERT(all_of<Event>(all).at(0).name == "CIP");
}

TEST(SinumerikArcs, MayHaveTheShareOfTheirLastTurnInTheirNumber) {
  const auto turns = [](std::string_view arc) {
    return last_of<ArcFeed>(run_sinumerik("G1 X10 Y0 Z0 F100\n" + std::string(arc))).turns;
  };
  EXPECT_EQ(turns("G2 X-10 Y0 Z-1 I-10 J0 TURN=.5\n"), -1);
  EXPECT_EQ(turns("G3 X0 Y-10 Z-1 I-10 J0 TURN=2.75\n"), 3);
  EXPECT_EQ(turns("G3 X10 Y0 Z-1 I-10 J0 TURN=1\n"), 2);
  const auto ids = [](std::string_view arc) {
    return complaint_ids("G1 X10 Y0 Z0 F100\n" + std::string(arc), {}, Dialect::sinumerik);
  };
  EXPECT_EQ(ids("G2 X-10 Y0 Z-1 I-10 J0 TURN=.25\n"), std::vector<std::string>{"not-whole"});
  EXPECT_EQ(ids("G2 X-10 Y0 Z-1 I-10 J0 TURN=-.5\n"), std::vector<std::string>{"not-whole"});
}

TEST(SinumerikArcs, InSpaceShareTheTimeOfTheirBlock) {
  const auto all = run_sinumerik("G0 X0 Y0 Z0\nG93\nCIP X10 Y0 Z5 I1=5 J1=5 K1=2 F4\n");
  double minutes = 0.0;
  for (const LinearFeed& line : all_of<LinearFeed>(all)) minutes += 1.0 / line.feed.value;
  EXPECT_NEAR(minutes, 0.25, 1e-12);
}

TEST(SinumerikArcs, LeadOnFromTheMoveBefore) {
  const ArcFeed arc = last_of<ArcFeed>(run_sinumerik("G0 X0 Y0 F100\nG1 X10\nCT X20 Y10\n"));
  EXPECT_LT((arc.center - Vec3(10, 10, 0)).norm(), 1e-9);
  EXPECT_EQ(arc.turns, 1);
  // From one arc into the next: the heading at (20, 10) is +Y.
  const auto arcs = all_of<ArcFeed>(run_sinumerik("G0 X0 Y0 F100\nG1 X10\nCT X20 Y10\nX0 Y10\n"));
  EXPECT_LT((arcs.at(1).center - Vec3(10, 10, 0)).norm(), 1e-9);
  EXPECT_EQ(arcs.at(1).turns, 1);
  const ArcFeed behind =
      last_of<ArcFeed>(run_sinumerik("G0 X0 Y0 F100\nG2 X10 Y10 I10\nCT X20 Y0\n"));
  EXPECT_LT((behind.center - Vec3(10, 0, 0)).norm(), 1e-9);
  EXPECT_EQ(behind.turns, -1);
  const ArcFeed through = last_of<ArcFeed>(
      run_sinumerik("G0 X0 Y0 F100\nCIP X10 Y10 I1=2.92893218813 J1=7.07106781187\nCT X20 Y0\n"));
  EXPECT_LT((through.center - Vec3(10, 0, 0)).norm(), 1e-6);
  const ArcFeed side =
      last_of<ArcFeed>(run_sinumerik("G18 G0 X0 Y3 Z0 F100\nG1 Z10\nCT Z20 X10\n"));
  EXPECT_LT((side.center - Vec3(10, 3, 10)).norm(), 1e-9);
  EXPECT_EQ(side.plane, Plane::zx);
  EXPECT_EQ(side.turns, 1);
  // To a polar end; with a move along the normal between, which has no direction in the plane.
  const ArcFeed polar = last_of<ArcFeed>(
      run_sinumerik("G0 X0 Y0 Z0 F100\nG1 X10\nZ-1\nG111 X10 Y10\nCT AP=0 RP=10\n"));
  EXPECT_LT((polar.center - Vec3(10, 10, -1)).norm(), 1e-9);
}

// --- Threads -------------------------------------------------------------------------------------

TEST(SinumerikThreads, FollowTheSpindleByTheLeadOfTheLongerWay) {
  const Feed feed = last_of<LinearFeed>(run_sinumerik("G0 X0 Y0 Z0 S500 M3\nG33 Z-20 K2\n")).feed;
  EXPECT_TRUE(feed.synchronised);
  EXPECT_EQ(feed.mode, FeedMode::per_revolution);
  EXPECT_DOUBLE_EQ(feed.value, 2.0);
  EXPECT_DOUBLE_EQ(last_of<LinearFeed>(run_sinumerik("G0 X0 S500 M3\nG33 X5 I0.5\n")).feed.value,
                   0.5);
  // Along Z 2 mm a turn, on a way of 5 and 20 mm.
  EXPECT_NEAR(
      last_of<LinearFeed>(run_sinumerik("G0 X0 Y0 Z0 S500 M3\nG33 X5 Z-20 K2\n")).feed.value,
      2 * std::hypot(5, 20) / 20, 1e-12);
  // At 45 degrees, with places that are rounded.
  EXPECT_NEAR(
      last_of<LinearFeed>(run_sinumerik("G0 X0 Y0 Z0 S500 M3\nG33 X5.000001 Z-5 K2\n")).feed.value,
      2 * std::sqrt(2.0), 1e-6);
}

}  // namespace
}  // namespace frustum::parser
