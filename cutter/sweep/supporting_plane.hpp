// A plane that goes with a body of revolution, turned about its axis to a fixed side.
//
// Model    : at an axis a the plane's normal is lateral * (what of `side` is perpendicular to a, as
//            a unit) + axial * a, and its distance from the tip is `offset`: whichever side a body
//            of revolution turns to the plane, one that touches it keeps touching
// Units    : mm; frame: workpiece
// Errors   : none; a side along the axis is the caller's mistake
// Accuracy : 1e-12 mm
#pragma once

#include "core/pose.hpp"
#include "cutter/body/profile.hpp"

namespace frustum::cutter {

struct SupportingPlane {
  double axial = 0.0, lateral = 0.0;  // of the unit normal: along the axis, and across it
  double offset = 0.0;                // from the tip
  Vec3 side = Vec3::Zero();           // unit; negligible where lateral is 0

  // Of an axis that `side` is perpendicular to.
  [[nodiscard]] Vec3 normal_across(const Vec3& axis) const { return lateral * side + axial * axis; }
  [[nodiscard]] Vec3 normal_at(const Vec3& axis) const {
    if (lateral == 0.0) return axial * axis;
    const Vec3 turned = side - side.dot(axis) * axis;
    return axial * axis + (lateral / turned.norm()) * turned;
  }
  // How far the point is beyond the plane when the body is at the pose.
  [[nodiscard]] double height(const ToolPose& pose, const Vec3& point) const {
    return normal_at(pose.axis).dot(point - pose.tip) - offset;
  }
};

}  // namespace frustum::cutter
