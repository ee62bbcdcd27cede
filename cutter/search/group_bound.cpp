#include "cutter/search/group_bound.hpp"

#include <limits>

namespace frustum::cutter {

double normal_turn(const PoseGroup& group) {
  return group.axis_shift * (1.0 + 2.0 * group.axis_shift);
}

// At another pose, tip p + dp and axis a + da, the normal is n + dn, dn = axial da - lateral
// (side.da) a within 2 |da|^2; the point at y from the tip is then n.dp + dn.dp - dn.y less beyond
// the plane.
double most_lost(const SupportingPlane& plane, const PoseGroup& group, const Vec3& y) {
  constexpr double kFarTurned = 0.5;  // the expansion holds below
  const double turned = group.axis_shift;
  if (turned > kFarTurned) return std::numeric_limits<double>::infinity();
  const Vec3& axis = group.representative.axis;
  const double by_tip = farthest_tip(group, plane.normal_across(axis));
  if (turned == 0.0) return by_tip;
  const Vec3 c = plane.lateral * y.dot(axis) * plane.side - plane.axial * y;
  return by_tip + farthest_axis(group, c) + normal_turn(group) * group.tip_shift +
         2.0 * turned * turned * y.norm();
}

}  // namespace frustum::cutter
