#include "cutter/search/separating_plane.hpp"

#include <algorithm>
#include <cmath>

#include "cutter/search/group_bound.hpp"

namespace frustum::cutter {

namespace {

// The rim of a flat or conical face that the point is on, if it is.
std::optional<Zone> rim_at(const Profile& section, const ToolPose& pose, const Vec3& point) {
  constexpr double kOnRim = 1e-6;  // mm: an end is within 1e-9 along the ray, more along the face
  const Vec3 m = point - pose.tip;
  const double z = m.dot(pose.axis);
  const double rho = (m - z * pose.axis).norm();
  for (const Zone& zone : section.zones()) {
    if (zone.kind != ZoneKind::cone) continue;
    for (const double height : {zone.z_lo, zone.z_hi}) {
      const double radius = zone.radius + zone.slope * (height - zone.z_lo);
      if (radius > kOnRim && std::abs(z - height) < kOnRim && std::abs(rho - radius) < kOnRim) {
        return torus_zone(radius, 0.0, height, height, height);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

SeparatingPlane::SeparatingPlane(const Body& body, const Ray& ray, const EndContact& end,
                                 bool leaving)
    : end_(ray.at(end.s)), beyond_(leaving ? ray.direction : Vec3(-ray.direction)) {
  if (end.section == kConcaveSurface) return;
  const Profile& section = body.sections()[end.section];
  body_ = &body;
  if (end.face >= 0) {
    const Zone& zone = section.zones()[static_cast<std::size_t>(end.face)];
    if (zone.kind != ZoneKind::cone) {
      is_round_ = true;
      round_ = zone;
      return;
    }
  }
  if (const auto rim = rim_at(section, end.pose, end_)) {
    is_round_ = true;
    round_ = *rim;
    return;
  }
  const Facing facing = section.facing(end.face, end.pose, end_, beyond_);
  axial_ = facing.axial;
  lateral_ = facing.lateral;
  offset_ = support(lateral_, axial_);
}

double SeparatingPlane::support(double lateral, double axial) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Profile& section : body_->sections())
    most = std::max(most, section.support(lateral, axial));
  return most;
}

// A plane that touches a convex body where the round face is has all of the body on one side.
double SeparatingPlane::support_of_round(double lateral, double axial) const {
  const double touched_at = round_.centre + round_.radius * axial;
  const bool on_face = round_.z_lo <= touched_at && touched_at <= round_.z_hi && lateral > 0.0;
  // A rim touches planes of its two faces' latitudes and between; the body says which.
  const bool is_rim = round_.radius == 0.0;
  if (!on_face || is_rim || !body_->is_convex()) return support(lateral, axial);
  return lateral * round_.major + axial * round_.centre + round_.radius;
}

std::optional<SupportingPlane> SeparatingPlane::touching(const ToolPose& pose) const {
  const Vec3 m = end_ - pose.tip;
  const double z = m.dot(pose.axis);
  const Vec3 across = m - z * pose.axis;
  const double rho = across.norm();
  SupportingPlane plane{axial_, lateral_, offset_};
  if (is_round_) {
    const double beside =
        round_.major < 0.0 ? rho - round_.major : std::max(0.0, rho - round_.major);
    const double above = z - round_.centre;
    const double length = std::sqrt(beside * beside + above * above);
    if (!(length > 0.0)) return std::nullopt;
    plane.lateral = beside / length;
    plane.axial = above / length;
    plane.offset = support_of_round(plane.lateral, plane.axial);
  }
  if (plane.lateral == 0.0) return plane;
  constexpr double kOnAxis = 1e-9;  // mm
  if (rho < kOnAxis) return std::nullopt;
  plane.side = across / rho;
  return plane;
}

Overreach SeparatingPlane::overreach(const PoseGroup& group, double slack) const {
  if (body_ == nullptr) return {};
  const std::optional<SupportingPlane> plane = touching(group.representative);
  if (!plane) return {};
  const Vec3 n = plane->normal_across(group.representative.axis);
  const double fall = n.dot(beyond_) - normal_turn(group);
  if (!(fall > 0.0)) return {};
  const Vec3 m = end_ - group.representative.tip;
  const double room = n.dot(m) - plane->offset + slack;
  constexpr double kRounding = 1e-12;  // mm
  return {(most_lost(*plane, group, m) - room) / fall, room < 0.0, kRounding / fall};
}

double SeparatingPlane::along(const ToolPose& pose) const {
  if (body_ == nullptr) return 0.0;
  const std::optional<SupportingPlane> plane = touching(pose);
  return plane ? plane->normal_across(pose.axis).dot(beyond_) : 0.0;
}

bool SeparatingPlane::holds(const SegmentMotion& motion, double slack) const {
  constexpr double kFarTurned = 0.05;  // plane_departure() holds up to here
  if (body_ == nullptr || motion.turn() > kFarTurned) return false;
  const ToolPose from = motion.at(0.0), to = motion.at(1.0);
  const std::optional<SupportingPlane> plane = touching(from);
  if (!plane) return false;
  const double departure =
      motion.turn() == 0.0
          ? 0.0
          : motion.plane_departure(1.0, std::max((end_ - from.tip).norm(), (end_ - to.tip).norm()),
                                   (to.tip - from.tip).norm());
  const Vec3 n = plane->normal_across(from.axis);
  if (!(n.dot(end_ - from.tip) - plane->offset + slack >= departure)) return false;
  if (!(n.dot(beyond_) > 1.1 * motion.turn())) return false;
  return plane->height(to, end_) + slack >= departure;
}

}  // namespace frustum::cutter
