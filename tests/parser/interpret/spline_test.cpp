// Splines as arcs: how near they are, and how they join.
#include "parser/interpret/moves/spline.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/parser/running.hpp"

namespace frustum::parser {
namespace {

constexpr double kTolerance = 1e-5;  // mm

double distance_to_spline(const PathPiece& piece, const Vec2& point) {
  const double ends = std::min((point - piece.start).norm(), (point - piece.end).norm());
  if (!piece.is_arc()) {
    const Vec2 along = direction_at_start(piece);
    const double way = along.dot(point - piece.start);
    return way < 0.0 || way > length_of(piece) ? ends
                                               : std::abs(left_of(along).dot(point - piece.start));
  }
  PathPiece to_point = piece;
  to_point.end = piece.centre + (point - piece.centre).normalized() * radius_of(piece);
  return sweep_of(to_point) > sweep_of(piece)
             ? ends
             : std::min(ends, std::abs((point - piece.centre).norm() - radius_of(piece)));
}

// By de Boor's recursion over the points with their weights; the parameter is from 0 to
// points - order + 1, the number of spans.
Vec2 point_of_spline(const std::vector<ControlPoint>& points, int order, double parameter) {
  const int degree = order - 1;
  const int spans = static_cast<int>(points.size()) - degree;
  const auto knot = [&](int i) {
    return std::clamp(static_cast<double>(i - degree), 0.0, 1.0 * spans);
  };
  const int span = std::clamp(static_cast<int>(parameter), 0, spans - 1);
  std::vector<Vec3> row;
  for (int i = span; i <= span + degree; ++i) {
    const ControlPoint& point = points.at(static_cast<std::size_t>(i));
    row.emplace_back(point.weight * point.place.x(), point.weight * point.place.y(), point.weight);
  }
  for (int level = 1; level <= degree; ++level) {
    for (int i = degree; i >= level; --i) {
      const double from = knot(span + i);
      const double part = (parameter - from) / (knot(span + i + degree + 1 - level) - from);
      const auto at = static_cast<std::size_t>(i);
      row[at] = (1.0 - part) * row[at - 1] + part * row[at];
    }
  }
  return row.back().head<2>() / row.back().z();
}

RC_GTEST_PROP(SplineLaws, TheArcsAreNearTheCurveAndJoinWithoutACorner, ()) {
  const int order = *rc::gen::inRange(3, 6);
  const int count = order + *rc::gen::inRange(0, 5);
  std::vector<ControlPoint> points;
  for (int i = 0; i < count; ++i) {
    // Each further on than the one before: no cusps.
    points.push_back(
        {{10.0 * i, *rc::gen::inRange(-400, 400) / 20.0}, *rc::gen::inRange(2, 30) / 10.0});
  }
  const auto pieces = arcs_of_spline(points, order, kTolerance);
  RC_ASSERT(!pieces.empty());
  RC_ASSERT((pieces.front().start - points.front().place).norm() < 1e-12);
  RC_ASSERT((pieces.back().end - points.back().place).norm() < 1e-9);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    RC_ASSERT((pieces[i].start - pieces[i - 1].end).norm() < 1e-9);
    const double bend =
        std::abs(signed_angle(direction_at_end(pieces[i - 1]), direction_at_start(pieces[i])));
    RC_ASSERT(bend < 1e-4);
  }
  const double parameters = count - order + 1;
  for (int i = 0; i <= 500; ++i) {
    const Vec2 point = point_of_spline(points, order, parameters * i / 500.0);
    double nearest = 1e9;
    for (const PathPiece& piece : pieces)
      nearest = std::min(nearest, distance_to_spline(piece, point));
    RC_ASSERT(nearest < 1.5 * kTolerance);
  }
}

TEST(Spline, OfThreeWeightedPointsIsACircle) {
  const double half = std::numbers::sqrt2 / 2.0;
  const std::vector<ControlPoint> points{{{20, 0}, 1}, {{20, 20}, half}, {{0, 20}, 1}};
  const auto pieces = arcs_of_spline(points, 3, kTolerance);
  ASSERT_EQ(pieces.size(), 2U);
  for (const PathPiece& piece : pieces) {
    EXPECT_NEAR(radius_of(piece), 20.0, 1e-9);
    EXPECT_LT(piece.centre.norm(), 1e-9);
    EXPECT_EQ(piece.turns, 1);
  }
}

TEST(Spline, OfOrderTwoIsItsPolygon) {
  const std::vector<ControlPoint> points{{{0, 0}, 1}, {{10, 0}, 2}, {{10, 5}, 1}};
  EXPECT_EQ(arcs_of_spline(points, 2, kTolerance).size(), 4U);
  EXPECT_LT((point_of_spline(points, 2, 1.0) - Vec2(10, 0)).norm(), 1e-12);
}

TEST(Spline, ThatTurnsBackOnItselfEnds) {
  const std::vector<ControlPoint> cusp{{{0, 0}, 1}, {{20, 10}, 1}, {{0, 10}, 1}, {{20, 0}, 1}};
  const auto pieces = arcs_of_spline(cusp, 4, kTolerance);
  EXPECT_GT(pieces.size(), 2U);
  EXPECT_LT(pieces.size(), 2000U);
  const std::vector<ControlPoint> there_and_back{{{0, 0}, 1}, {{20, 0}, 1}, {{0, 0}, 1}};
  EXPECT_LT(arcs_of_spline(there_and_back, 3, kTolerance).size(), 2000U);
  const std::vector<ControlPoint> point{{{3, 3}, 1}, {{3, 3}, 1}, {{3, 3}, 1}};
  EXPECT_TRUE(arcs_of_spline(point, 3, kTolerance).empty());
  const std::vector<ControlPoint> far{{{0, 0}, 1}, {{1e12, 1e12}, 1}, {{2e12, 0}, 1}};
  EXPECT_LT(arcs_of_spline(far, 3, kTolerance).size(), 100'000U);
}

TEST(Splines, OfAProgramAreTold) {
  const auto all =
      motions("G0 X0 Y0 Z0\nG93 G5 X10 Y10 I0 J3 P0 Q-3 F2\nG94\nM2\n", {}, Dialect::linuxcnc);
  const Event event = all_of<Event>(all).at(0);
  EXPECT_EQ(event.name, "spline");
  EXPECT_TRUE(event.text.starts_with("4 control points, ")) << event.text;
  double minutes = 0.0;
  for (const ArcFeed& arc : all_of<ArcFeed>(all)) minutes += 1.0 / arc.feed.value;
  for (const LinearFeed& line : all_of<LinearFeed>(all)) minutes += 1.0 / line.feed.value;
  EXPECT_NEAR(minutes, 0.5, 1e-9);
}

}  // namespace
}  // namespace frustum::parser
