#include "parser/interpret/moves/plane_path.hpp"
#include "core/constants.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

namespace frustum::parser {
namespace {

// A point that is this little after the end of an arc is its end, not a turn away from it.
constexpr double kSamePoint = 1e-9;  // mm

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }
double sense_of(const PathPiece& arc) { return arc.turns > 0 ? 1.0 : -1.0; }

// The way from one point of the arc's circle to another in the arc's sense, from 0 up to a full
// turn.
double way_round(const PathPiece& arc, const Vec2& from, const Vec2& to) {
  const double angle = sense_of(arc) * signed_angle(from - arc.centre, to - arc.centre);
  const double radius = radius_of(arc);
  const double way = (angle < 0.0 ? angle + kTurn : angle) * radius;
  return kTurn * radius - way < kSamePoint ? 0.0 : way;
}

std::vector<Vec2> crossings_with_line(const PathPiece& line, const Vec2& centre, double radius) {
  const Vec2 direction = direction_at_start(line);
  const double along = direction.dot(centre - line.start);
  const Vec2 foot = line.start + along * direction;
  const double distance = (centre - foot).norm();
  if (distance > radius + kSamePoint) return {};
  const double half = std::sqrt(std::max((radius - distance) * (radius + distance), 0.0));
  return {foot - half * direction, foot + half * direction};
}

std::vector<Vec2> crossings_of_circles(const PathPiece& a, const PathPiece& b) {
  const double ra = radius_of(a);
  const double rb = radius_of(b);
  const Vec2 between = b.centre - a.centre;
  const double distance = between.norm();
  if (distance < kSamePoint || distance > ra + rb + kSamePoint ||
      distance < std::abs(ra - rb) - kSamePoint) {
    return {};
  }
  const Vec2 direction = between / distance;
  const double along = (distance * distance + (ra - rb) * (ra + rb)) / (2.0 * distance);
  const double half = std::sqrt(std::max((ra - along) * (ra + along), 0.0));
  const Vec2 foot = a.centre + along * direction;
  return {foot - half * left_of(direction), foot + half * left_of(direction)};
}

}  // namespace

Vec2 left_of(const Vec2& direction) { return {-direction.y(), direction.x()}; }

double signed_angle(const Vec2& from, const Vec2& to) {
  return std::atan2(cross(from, to), from.dot(to));
}

double radius_of(const PathPiece& arc) { return (arc.start - arc.centre).norm(); }

double sweep_of(const PathPiece& arc) {
  const double angle = sense_of(arc) * signed_angle(arc.start - arc.centre, arc.end - arc.centre);
  const bool whole = (arc.end - arc.start).norm() < kSamePoint;
  return (whole ? kTurn : angle <= 0.0 ? angle + kTurn : angle) + kTurn * (std::abs(arc.turns) - 1);
}

double length_of(const PathPiece& piece) {
  return piece.is_arc() ? radius_of(piece) * sweep_of(piece) : (piece.end - piece.start).norm();
}

Vec2 direction_at_start(const PathPiece& piece) {
  if (!piece.is_arc()) return (piece.end - piece.start).normalized();
  return sense_of(piece) * left_of((piece.start - piece.centre).normalized());
}

Vec2 direction_at_end(const PathPiece& piece) {
  if (!piece.is_arc()) return direction_at_start(piece);
  return sense_of(piece) * left_of((piece.end - piece.centre).normalized());
}

double curvature_of(const PathPiece& piece) {
  return piece.is_arc() ? sense_of(piece) / radius_of(piece) : 0.0;
}

PathPiece parallel(const PathPiece& piece, double left) {
  PathPiece beside = piece;
  beside.start += left * left_of(direction_at_start(piece));
  beside.end += left * left_of(direction_at_end(piece));
  return beside;
}

std::vector<Vec2> crossings(const PathPiece& a, const PathPiece& b) {
  if (a.is_arc() && b.is_arc()) return crossings_of_circles(a, b);
  if (a.is_arc()) return crossings_with_line(b, a.centre, radius_of(a));
  if (b.is_arc()) return crossings_with_line(a, b.centre, radius_of(b));
  const Vec2 along_a = direction_at_start(a);
  const Vec2 along_b = direction_at_start(b);
  const double sine = cross(along_a, along_b);
  if (sine == 0.0) return {};
  return {a.start + along_a * (cross(b.start - a.start, along_b) / sine)};
}

double gap_between(const PathPiece& a, const PathPiece& b) {
  if (!a.is_arc() && !b.is_arc()) return 0.0;
  if (!a.is_arc()) return gap_between(b, a);
  const double radius = radius_of(a);
  if (!b.is_arc()) {
    const double distance = std::abs(cross(direction_at_start(b), a.centre - b.start));
    return std::max(distance - radius, 0.0);
  }
  const double other = radius_of(b);
  const double distance = (b.centre - a.centre).norm();
  return std::max({distance - radius - other, std::abs(radius - other) - distance, 0.0});
}

double lost_at_start(const PathPiece& piece, const Vec2& point) {
  if (piece.is_arc()) return way_round(piece, piece.start, point);
  return direction_at_start(piece).dot(point - piece.start);
}

double lost_at_end(const PathPiece& piece, const Vec2& point) {
  if (piece.is_arc()) return way_round(piece, point, piece.end);
  return direction_at_start(piece).dot(piece.end - point);
}

}  // namespace frustum::parser
