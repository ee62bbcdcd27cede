#include "cutter/search/pose_group.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::cutter {

PoseGroup GroupPair::group(std::size_t which) const {
  const auto vec = [which](const std::array<FloatPair, 3>& v) {
    return Vec3(v[0][which], v[1][which], v[2][which]);
  };
  PoseGroup group{.box = {vec(box_min), vec(box_max)},
                  .middle = {vec(tip), vec(axis)},
                  .tip_half = vec(tip_half),
                  .axis_half = vec(axis_half),
                  .axis_shift = axis_shift[which],
                  .tip_turn = tip_turn[which],
                  .shift = shift[which],
                  .representative_segment = representative_segment[which],
                  .earliest = earliest[which],
                  .count = count[which]};
  const Vec3 one = vec(first_column), two = vec(second_column);
  group.frame << one, two, one.cross(two);
  (group.count > 0 ? group.first : group.children) =
      group.count > 0 ? next[which] : 2 * next[which];
  return group;
}

double support(const PoseGroup& group, const Profile& body, const Vec3& normal) {
  const Vec3 n = (group.frame.transpose() * normal).cwiseAbs();
  const double u = normal.dot(group.middle.axis), turns = n.dot(group.axis_half);
  const double u_lo = std::max(-1.0, u - turns), u_hi = std::min(1.0, u + turns);
  // Heights count with the largest n.axis, radii with the one nearest to zero.
  const double nearest = std::clamp(0.0, std::min(u_lo, u_hi), u_hi);
  return n.dot(group.tip_half) +
         body.support(std::sqrt(std::max(0.0, 1.0 - nearest * nearest)), u_hi);
}

}  // namespace frustum::cutter
