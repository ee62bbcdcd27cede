// A plane that goes with a body of revolution, turned about its axis to a side that stays where it is.
//
// Model    : at an axis a the plane's normal is lateral * (what of `side` is square to a, as a unit) +
//            axial * a, and it lies at `offset` from the tip: whichever side a body of revolution turns to the
//            plane, one that touches it keeps touching
// Units    : mm; frame: workpiece
// Errors   : none; a side along the axis is the caller's mistake
// Accuracy : 1e-12 mm
#pragma once

#include "cutter/search/pose_tree.hpp"

namespace frustum::cutter {

struct SupportingPlane {
  double axial = 0.0, lateral = 0.0;  // of the unit normal: along the axis, and across it
  double offset = 0.0;                // from the tip
  Vec3 side = Vec3::Zero();           // unit; of no account where lateral is 0

  // Of an axis that `side` is square to.
  [[nodiscard]] Vec3 normal_square_to(const Vec3& axis) const {
    return lateral * side + axial * axis;
  }
  [[nodiscard]] Vec3 normal_at(const Vec3& axis) const {
    if (lateral == 0.0) return axial * axis;
    const Vec3 turned = side - side.dot(axis) * axis;
    return axial * axis + (lateral / turned.norm()) * turned;
  }
  // How far the point is beyond the plane when the body stands at the pose.
  [[nodiscard]] double height(const ToolPose& pose, const Vec3& point) const {
    return normal_at(pose.axis).dot(point - pose.tip) - offset;
  }
};

// The normal of a plane that touches the representative turns by at most this at the group's other poses (rad).
[[nodiscard]] double normal_turn(const PoseGroup& group);
// And by at most so much less is a point, `y` from the representative's tip, beyond it there. `side` is square to the
// representative's axis. Infinite for a group whose axes differ by more than 0.5 rad.
[[nodiscard]] double most_lost(const SupportingPlane& plane, const PoseGroup& group, const Vec3& y);

}  // namespace frustum::cutter
