#include "cutter/sweep/tangent_plane.hpp"

#include <algorithm>
#include <limits>

namespace frustum::cutter {

TangentPlane::TangentPlane(const Profile& body, const ToolPose& pose, const Ray& ray,
                           const Chord& chord, bool leaving)
    : direction(leaving ? 1.0 : -1.0) {
  const double s = leaving ? chord.hi : chord.lo;
  const Vec3 point = ray.at(s);
  const Facing at =
      body.facing(leaving ? chord.hi_face : chord.lo_face, pose, point, direction * ray.direction);
  axial = at.axial;
  lateral = at.lateral;
  side = at.side;
  const Vec3 normal = normal_across(pose.axis);
  value = direction * s;
  // A grazing ray leaves the plane nowhere, or by rounding on the wrong side.
  along = std::max(direction * normal.dot(ray.direction), 1e-12);
  offset = normal.dot(point - pose.tip);
}

PlaneCrossing TangentPlane::crossing(const ToolPose& pose, const Ray& ray) const {
  const Vec3 n = normal_at(pose.axis);
  const double fall = direction * n.dot(ray.direction);
  if (!(fall > 0.0)) return {std::numeric_limits<double>::infinity(), 0.0};
  return {(offset - n.dot(ray.origin - pose.tip)) / fall, fall};
}

}  // namespace frustum::cutter
