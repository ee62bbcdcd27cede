// Straight lines and arcs in a plane, their parallels and their crossings.
//
// Model    : coordinates (u, v) of the plane's axes, counterclockwise positive; left is left of the
//            way
// Units    : mm, rad
// Shape    : a straight piece has a length above zero, an arc a radius above zero
// Errors   : none; crossings() gives none where there are none
// Accuracy : 1e-12 relative to the coordinates
// Source   : the lines and circles of plane analytic geometry
#pragma once

#include <Eigen/Core>
#include <vector>

namespace frustum::parser {

using Vec2 = Eigen::Vector2d;

struct PathPiece {
  Vec2 start = Vec2::Zero();
  Vec2 end = Vec2::Zero();
  Vec2 centre = Vec2::Zero();  // of an arc
  int turns = 0;  // 0: straight; > 0 counterclockwise; |turns| - 1 revolutions beyond the first

  [[nodiscard]] bool is_arc() const { return turns != 0; }
};

[[nodiscard]] Vec2 left_of(const Vec2& direction);
// From one direction to another, in (-pi, pi]; counterclockwise positive.
[[nodiscard]] double signed_angle(const Vec2& from, const Vec2& to);

[[nodiscard]] double radius_of(const PathPiece& arc);
[[nodiscard]] double sweep_of(const PathPiece& arc);  // > 0; 2 pi a full circle
[[nodiscard]] double length_of(const PathPiece& piece);
[[nodiscard]] Vec2 direction_at_start(const PathPiece& piece);
[[nodiscard]] Vec2 direction_at_end(const PathPiece& piece);
[[nodiscard]] double curvature_of(const PathPiece& piece);  // 1/mm, positive to the left

// The piece `left` mm to its left (below zero: to its right). An arc that it leaves no radius has
// none.
[[nodiscard]] PathPiece parallel(const PathPiece& piece, double left);

// Where the lines and circles that two pieces are on meet: none, one or two points.
[[nodiscard]] std::vector<Vec2> crossings(const PathPiece& a, const PathPiece& b);
// How far apart the two are where they do not meet; 0 where they do, or for lines.
[[nodiscard]] double gap_between(const PathPiece& a, const PathPiece& b);

// How much of the piece is lost, along it, when it begins or ends at `point` of its line or circle.
// Below zero for a straight piece that gets longer; an arc goes round.
[[nodiscard]] double lost_at_start(const PathPiece& piece, const Vec2& point);
[[nodiscard]] double lost_at_end(const PathPiece& piece, const Vec2& point);

}  // namespace frustum::parser
