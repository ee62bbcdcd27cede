// The motion of a cutter over one segment of a tool path, with what bounds it.
//
// Model    : tip linear in t, axis on a great circle, t in [0, 1]
// Units    : mm, rad; frame: workpiece
// Errors   : none; no motion and pure rotation are ordinary
// Accuracy : the axis is a unit vector within 4e-16
#pragma once

#include <optional>

#include "core/diagnostic.hpp"
#include "kinematics/path/tool_path.hpp"

namespace frustum::cutter {

using kinematics::ToolPose;

// Of a path that turns its tool by half a turn between two poses: they do not say which way.
[[nodiscard]] std::optional<Diagnostic> half_turn(const kinematics::ToolPath& path);

class SegmentMotion {
 public:
  // `reach`: no point of the cutter is farther than this from the tip.
  SegmentMotion(const ToolPose& from, const ToolPose& to, double reach);
  SegmentMotion(const kinematics::ToolPath& path, const kinematics::PathSegment& segment,
                double reach);
  [[nodiscard]] ToolPose at(double t) const;
  // How fast a point that goes with the cutter moves (mm a segment) when it is at `point` at time
  // t.
  [[nodiscard]] Vec3 velocity(const Vec3& point, double t) const;
  // No point of the cutter moves more than this in the whole segment (mm).
  [[nodiscard]] double travel() const { return travel_; }
  [[nodiscard]] double reach() const { return reach_; }
  // The cutter turns by this (rad).
  [[nodiscard]] double turn() const { return turn_; }
  // Second derivative to t of any cutter point's place, at most (mm): over a part dt of the segment
  // no point leaves the straight line between its ends by more than bend dt^2 / 8.
  [[nodiscard]] double bend() const { return bend_; }
  // A plane that goes with the cutter, turned about its axis to a fixed side: how far, over a part
  // dt of the segment in which the cutter turns by at most 0.3 rad, its height over a point, or
  // where a ray crosses it, may leave the straight line between the ends, at most (mm). `away`:
  // from the tip to the point; `run`: way of the point relative to the tip.
  [[nodiscard]] double plane_departure(double dt, double away, double run) const;

 private:
  ToolPose from_;
  ToolPose to_;
  Vec3 step_;
  double reach_;
  double turn_;
  double sin_turn_;
  double travel_;
  double bend_;
};

}  // namespace frustum::cutter
