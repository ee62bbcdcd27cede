#include "cutter/sweep/segment_motion.hpp"

#include <cmath>

namespace frustum::cutter {
namespace {

// Below this the series for the sine, to the ninth power, is exact within rounding.
constexpr double kSmallTurn = 0.1;  // rad

double sine(double x) {
  if (x > kSmallTurn) return std::sin(x);
  const double x2 = x * x;
  return x * (1.0 - x2 / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0 * (1.0 - x2 / 72.0))));
}

// The angle between unit vectors, from the chord between them.
double angle(const Vec3& a, const Vec3& b) {
  const double chord2 = (b - a).squaredNorm();
  if (chord2 == 0.0) return 0.0;
  if (chord2 > kSmallTurn * kSmallTurn) return angle_between(a, b);
  return std::sqrt(chord2) *
         (1.0 + chord2 / 24.0 * (1.0 + chord2 * (9.0 / 80.0) * (1.0 + chord2 * (25.0 / 168.0))));
}

}  // namespace

std::optional<Diagnostic> half_turn(const kinematics::ToolPath& path) {
  constexpr double kOpposite = 1e-6;
  for (const kinematics::PathSegment& segment : path.segments) {
    if ((path.from(segment).axis + path.to(segment).axis).norm() > kOpposite) continue;
    Diagnostic fault =
        error("half-turn"_id, "the tool turns by half a turn between two poses of the path",
              "the poses do not say which way: put one between them");
    fault.line = static_cast<int>(path.blocks[segment.block].source_line);
    return fault;
  }
  return std::nullopt;
}

SegmentMotion::SegmentMotion(const ToolPose& from, const ToolPose& to, double reach)
    : from_(from),
      to_(to),
      step_(to.tip - from.tip),
      reach_(reach),
      turn_(angle(from.axis, to.axis)),
      sin_turn_(sine(turn_)),
      travel_(step_.norm() + reach * turn_),
      bend_(reach * turn_ * turn_) {}

SegmentMotion::SegmentMotion(const kinematics::ToolPath& path,
                             const kinematics::PathSegment& segment, double reach)
    : SegmentMotion(path.from(segment), path.to(segment), reach) {}

ToolPose SegmentMotion::at(double t) const {
  if (t == 0.0) return from_;
  if (t == 1.0) return to_;
  if (turn_ == 0.0) return {from_.tip + t * step_, from_.axis};
  const double a = sine((1.0 - t) * turn_) / sin_turn_;
  const double b = sine(t * turn_) / sin_turn_;
  return {from_.tip + t * step_, a * from_.axis + b * to_.axis};
}

Vec3 SegmentMotion::velocity(const Vec3& point, double t) const {
  if (turn_ == 0.0) return step_;
  const Vec3 about = from_.axis.cross(to_.axis) * (turn_ / sin_turn_);
  return step_ + about.cross(point - from_.tip - t * step_);
}

// With n(t) the plane's normal, seen from a point x(t) that runs along a line, the distance n.(x -
// p) has the second derivative n''.(x - p) + 2 n'.(x' - p'). Turning at the rate w, n = axial a +
// lateral b with b across the axis: |a''| = w^2, and up to 0.3 rad the projection of a fixed side
// bends b by at most 1.25 w^2 and turns n by at most 1.05 w.
double SegmentMotion::plane_departure(double dt, double away, double run) const {
  constexpr double kTurns = 1.1, kBends = 1.9;
  const double turn = turn_ * dt;
  return (kBends * turn * turn * away + 2.0 * kTurns * turn * run) / 8.0;
}

}  // namespace frustum::cutter
