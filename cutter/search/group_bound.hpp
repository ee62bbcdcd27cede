// A plane that touches a cutter, and how far beyond it the cutter reaches at any pose of a group.
//
// Model    : a body of revolution at tip p and axis a is below h(x) = lateral |m x a| + axial m.a -
//            offset = 0, m = x - p, where (axial, lateral) is a unit normal in its meridian and
//            offset its support there: the body's own plane of that latitude, turned to the side of
//            x. As |m x a| >= w.(m x a) for every unit vector w, h is at least a function that is
//            linear in p and in a but for w.(m x a) and m.a, whose bilinear parts make together no
//            more than |dp| |da|. Its least over the oriented boxes of a group is therefore known,
//            and so is how fast it rises along a ray
// Units    : mm, rad; frame: workpiece
// Errors   : none
// Accuracy : bounds hold within rounding (1e-12 mm), for every choice of the latitude and of w, and
//            however much the axes differ
// Source   : ours
#pragma once

#include "cutter/search/pose_group.hpp"

namespace frustum::cutter {

// A latitude of a body, and a unit vector across the meridian in which it is looked at.
struct LatitudePlane {
  double axial = 0.0, lateral = 0.0;
  double offset = 0.0;
  Vec3 across = Vec3::Zero();
};

// How far along a direction from a point any cutter of the group may reach (mm; infinite: no bound)
// and, for tolerances normal to the plane, the least cosine between normal and direction.
struct GroupBeyond {
  double most = 0.0;
  double fall = 0.0;
};
[[nodiscard]] GroupBeyond most_beyond(const PoseGroup& group, const LatitudePlane& plane,
                                      const Vec3& point, const Vec3& direction);

}  // namespace frustum::cutter
