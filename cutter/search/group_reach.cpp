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

// Beyond what place along the ray no pose of the group reaches, by the plane that touches the
// representative.
double crossing(const TangentPlane& plane, const PoseGroup& group, const Ray& ray) {
  const double fall = plane.along - normal_turn(group);
  if (!(fall > 0.0)) return kInfinity;
  const Vec3 touched = ray.at(plane.direction * plane.value) - group.representative.tip;
  return plane.value + std::max(0.0, most_lost(plane, group, touched)) / fall;
}

// What the tolerance normal to the plane makes along the ray, at any pose of the group.
double slack_of(const TangentPlane& plane, const PoseGroup& group) {
  return kSearchTolerance / (plane.along + normal_turn(group));
}

bool surely_apart(const PoseGroup& group, const Profile& part, const Ray& ray) {
  const Vec3 offset = ray.origin - group.representative.tip;
  const auto apart = [&](const Vec3& n) { return n.dot(offset) > support(group, part, n); };
  const Vec3 across = ray.direction.cross(group.representative.axis);
  const double sine = across.norm();
  if (sine > 1e-3) {
    const double side = across.dot(offset) > 0.0 ? 1.0 : -1.0;
    if (apart(across * (side / sine))) return true;
  }
  const Vec3 facing =
      group.representative.axis - ray.direction.dot(group.representative.axis) * ray.direction;
  const double length = facing.norm();
  if (length < 1e-3) return false;
  const double middle = 0.5 * (part.bottom() + part.height());
  const double side = facing.dot(offset) > middle * length * length ? 1.0 : -1.0;
  return apart(facing * (side / length));
}

}  // namespace

GroupReach reach_of(const PoseGroup& group, const Profile& part, const Ray& ray,
                    const std::optional<Chord>& known, WantedEnds wanted) {
  if (!known) {
    if (surely_apart(group, part, ray)) return kNoReach;
    const auto grown = part.chord(group.representative, ray, group.shift);
    return grown ? GroupReach{grown->lo, grown->hi} : kNoReach;
  }
  GroupReach reach{-kInfinity, kInfinity};
  double along = 1.0;
  if (wanted.hi) {
    const TangentPlane leaving(part, group.representative, ray, *known, true);
    reach.hi = crossing(leaving, group, ray);
    reach.hi_slack = slack_of(leaving, group);
    along = leaving.along;
  }
  if (wanted.lo) {
    const TangentPlane entering(part, group.representative, ray, *known, false);
    reach.lo = -crossing(entering, group, ray);
    reach.lo_slack = slack_of(entering, group);
    along = std::min(along, entering.along);
  }
  if (along >= kGrazing && group.axis_shift <= kMuchTurned) return reach;
  if (const auto grown = part.chord(group.representative, ray, group.shift)) {
    if (grown->lo > reach.lo) reach.lo_slack = 0.0;
    if (grown->hi < reach.hi) reach.hi_slack = 0.0;
    reach.lo = std::max(reach.lo, grown->lo);
    reach.hi = std::min(reach.hi, grown->hi);
  }
  return reach;
}

}  // namespace frustum::cutter
