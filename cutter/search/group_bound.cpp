#include "cutter/search/group_bound.hpp"

#include <limits>

namespace frustum::cutter {

GroupBeyond most_beyond(const PoseGroup& group, const LatitudePlane& plane, const Vec3& point,
                        const Vec3& direction) {
  const Vec3& a = group.middle.axis;
  const Vec3 m = point - group.middle.tip;
  const Vec3& w = plane.across;
  // What the height loses with dp and gains with da.
  const Vec3 by_tip = plane.lateral * a.cross(w) + plane.axial * a;
  const double fall = by_tip.dot(direction) - group.axis_shift;
  if (!(fall > 0.0)) return {std::numeric_limits<double>::infinity(), fall};
  const double height = by_tip.dot(m) - plane.offset;
  double lost = (group.frame.transpose() * by_tip).cwiseAbs().dot(group.tip_half);
  if (group.axis_shift > 0.0) {
    const Vec3 by_axis = plane.lateral * w.cross(m) + plane.axial * m;
    lost += (group.frame.transpose() * by_axis).cwiseAbs().dot(group.axis_half) + group.tip_turn;
  }
  return {(lost - height) / fall, fall};
}

}  // namespace frustum::cutter
