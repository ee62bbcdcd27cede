#include "cutter/search/pose_group.hpp"

#include <algorithm>
#include <cmath>

namespace frustum::cutter {

PoseGroup GroupQuad::group(std::size_t lane) const {
  const auto vec = [lane](const std::array<FloatFour, 3>& v) {
    return Vec3(v[0][lane], v[1][lane], v[2][lane]);
  };
  PoseGroup group{.box = {vec(box_min), vec(box_max)},
                  .middle = {vec(tip), vec(axis)},
                  .tip_half = vec(tip_half),
                  .axis_half = vec(axis_half),
                  .axis_shift = axis_shift[lane],
                  .tip_turn = tip_turn[lane],
                  .shift = shift[lane],
                  .representative_segment = representative_segment[lane],
                  .representative_pose = representative_pose[lane],
                  .earliest = earliest[lane],
                  .count = count[lane]};
  const Vec3 one = vec(first_column), two = vec(second_column);
  group.frame << one, two, one.cross(two);
  (group.count > 0 ? group.first : group.children) =
      group.count > 0 ? next[lane] : kSiblings * next[lane];
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
