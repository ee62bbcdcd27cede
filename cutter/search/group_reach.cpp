#include "cutter/search/group_reach.hpp"

#include <algorithm>

#include "core/constants.hpp"
#include "cutter/search/group_bound.hpp"
#include "cutter/sweep/segment_sweep.hpp"
#include "cutter/sweep/tangent_plane.hpp"

namespace frustum::cutter {
namespace {

// Below this cosine between ray and surface the touching planes bound badly; the grown cutter
// helps.
constexpr double kGrazing = 0.02;
// And where the axes of a group differ by more than this (rad).
constexpr double kMuchTurned = 0.1;

// Beyond what place along the ray (counted in the plane's direction) no pose of the group reaches,
// by the plane that touches the representative; and what the tolerance normal to the plane makes
// there.
struct Crossing {
  double value;
  double slack;
};
Crossing crossing(const TangentPlane& plane, const ToolPose& representative, const PoseGroup& group,
                  const Ray& ray) {
  const LatitudePlane latitude{plane.axial, plane.lateral, plane.offset,
                               plane.side.cross(representative.axis)};
  const GroupBeyond beyond = most_beyond(group, latitude, ray.at(plane.direction * plane.value),
                                         plane.direction * ray.direction);
  return {plane.value + std::max(0.0, beyond.most),
          kSearchTolerance / (plane.along + 2.0 * group.axis_shift)};
}

bool surely_apart(const PoseGroup& group, const Profile& part, const Ray& ray) {
  const Vec3 offset = ray.origin - group.middle.tip;
  const auto apart = [&](const Vec3& n) { return n.dot(offset) > support(group, part, n); };
  const Vec3 across = ray.direction.cross(group.middle.axis);
  const double sine = across.norm();
  if (sine > 1e-3) {
    const double side = across.dot(offset) > 0.0 ? 1.0 : -1.0;
    if (apart(across * (side / sine))) return true;
  }
  const Vec3 facing = group.middle.axis - ray.direction.dot(group.middle.axis) * ray.direction;
  const double length = facing.norm();
  if (length < 1e-3) return false;
  const double middle = 0.5 * (part.bottom() + part.height());
  const double side = facing.dot(offset) > middle * length * length ? 1.0 : -1.0;
  return apart(facing * (side / length));
}

}  // namespace

GroupReach reach_of(const PoseGroup& group, const ToolPose& representative, const Profile& part,
                    const Ray& ray, const std::optional<Chord>& known, WantedEnds wanted) {
  if (!known) {
    if (surely_apart(group, part, ray)) return kNoReach;
    const auto grown = part.chord(representative, ray, group.shift);
    return grown ? GroupReach{grown->lo, grown->hi} : kNoReach;
  }
  GroupReach reach{-kInfinity, kInfinity};
  double along = 1.0;
  if (wanted.hi) {
    const TangentPlane leaving(part, representative, ray, *known, true);
    const Crossing at = crossing(leaving, representative, group, ray);
    reach.hi = at.value;
    reach.hi_slack = at.slack;
    along = leaving.along;
  }
  if (wanted.lo) {
    const TangentPlane entering(part, representative, ray, *known, false);
    const Crossing at = crossing(entering, representative, group, ray);
    reach.lo = -at.value;
    reach.lo_slack = at.slack;
    along = std::min(along, entering.along);
  }
  if (along >= kGrazing && group.axis_shift <= kMuchTurned) return reach;
  if (const auto grown = part.chord(representative, ray, group.shift)) {
    if (grown->lo > reach.lo) reach.lo_slack = 0.0;
    if (grown->hi < reach.hi) reach.hi_slack = 0.0;
    reach.lo = std::max(reach.lo, grown->lo);
    reach.hi = std::min(reach.hi, grown->hi);
  }
  return reach;
}

}  // namespace frustum::cutter
