// A supporting plane of a group's representative, and how much less it bounds at the group's other
// poses.
//
// Model    : at another pose of the group, tip p + dp and axis a + da, the plane has turned with
//            the axis and
//            moved with the tip; both are bounded by the group's oriented boxes
// Units    : mm, rad; frame: workpiece
// Errors   : none
// Accuracy : bounds hold within rounding (1e-12 mm)
#pragma once

#include "cutter/search/pose_tree.hpp"
#include "cutter/sweep/supporting_plane.hpp"

namespace frustum::cutter {

// The normal of a plane that touches the representative turns by at most this at the other poses
// (rad).
[[nodiscard]] double normal_turn(const PoseGroup& group);
// And by at most so much less is a point, `y` from the representative's tip, beyond it there (mm).
// `side` is perpendicular to the representative's axis. Infinite for a group whose axes differ by
// more than 0.5 rad.
[[nodiscard]] double most_lost(const SupportingPlane& plane, const PoseGroup& group, const Vec3& y);

}  // namespace frustum::cutter
