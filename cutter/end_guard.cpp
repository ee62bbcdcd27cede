#include "cutter/end_guard.hpp"

#include <algorithm>
#include <cmath>

#include "cutter/stretch_sweep.hpp"

namespace frustum::cutter {

EndGuard::EndGuard(const Body& body, const Ray& ray, const EndContact& end, bool leaving)
    : end_(ray.at(end.s)), beyond_(leaving ? ray.direction : Vec3(-ray.direction)) {
  if (end.part >= body.parts().size()) return;
  const Profile& part = body.parts()[end.part];
  body_ = &body;
  if (end.face >= 0) {
    const Zone& zone = part.zones()[static_cast<std::size_t>(end.face)];
    if (zone.kind != ZoneKind::cone) {
      round_ = &zone;
      return;
    }
  }
  const Facing facing = part.facing(end.face, end.pose, end_, beyond_);
  axial_ = facing.axial;
  lateral_ = facing.lateral;
  offset_ = support(lateral_, axial_);
}

double EndGuard::support(double lateral, double axial) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Profile& part : body_->parts()) most = std::max(most, part.support(lateral, axial));
  for (const Profile& hull : body_->carved()) most = std::max(most, hull.support(lateral, axial));
  return most;
}

// A plane that touches a convex body where the round face is has all of the body on one side.
double EndGuard::support_of_round(double lateral, double axial) const {
  const double touched_at = round_->centre + round_->radius * axial;
  const bool on_face = round_->z_lo <= touched_at && touched_at <= round_->z_hi && lateral > 0.0;
  if (!on_face || !body_->is_convex()) return support(lateral, axial);
  return lateral * round_->major + axial * round_->centre + round_->radius;
}

// The plane that touches the body standing there, square to the way to the end.
std::optional<EndGuard::Plane> EndGuard::touching(const ToolPose& pose) const {
  const Vec3 m = end_ - pose.tip;
  const double z = m.dot(pose.axis);
  const Vec3 across = m - z * pose.axis;
  const double rho = across.norm();
  Plane plane{axial_, lateral_, offset_};
  if (round_ != nullptr) {
    const double beside =
        round_->major < 0.0 ? rho - round_->major : std::max(0.0, rho - round_->major);
    const double above = z - round_->centre;
    const double length = std::sqrt(beside * beside + above * above);
    if (!(length > 0.0)) return std::nullopt;
    plane.lateral = beside / length;
    plane.axial = above / length;
    plane.offset = support_of_round(plane.lateral, plane.axial);
  }
  plane.height = plane.lateral * rho + plane.axial * z - plane.offset;
  if (plane.lateral == 0.0) return plane;
  constexpr double kOnAxis = 1e-9;  // mm
  if (rho < kOnAxis) return std::nullopt;
  plane.side = across / rho;
  return plane;
}

// At another pose, tip p + dp and axis a + da, the normal n turns by dn = axial da - lateral (side.da) a
// within 2 |da|^2; with m from the tip to the end, the end is n.dp + dn.dp - dn.m nearer to the plane.
Overreach EndGuard::overreach(const PoseGroup& group) const {
  constexpr double kFarTurned = 0.5;  // the expansion holds below
  const double turned = group.axis_shift;
  if (body_ == nullptr || turned > kFarTurned) return {};
  const std::optional<Plane> plane = touching(group.witness);
  if (!plane) return {};
  const Vec3 n = plane->lateral * plane->side + plane->axial * group.witness.axis;
  const double turn = turned * (1.0 + 2.0 * turned);
  const double fall = n.dot(beyond_) - turn;
  if (!(fall > 0.0)) return {};
  double nearer = farthest_tip(group, n);
  if (turned > 0.0) {
    const Vec3 m = end_ - group.witness.tip;
    const Vec3 c = plane->lateral * m.dot(group.witness.axis) * plane->side - plane->axial * m;
    nearer += farthest_axis(group, c) + turn * group.tip_shift + 2.0 * turned * turned * m.norm();
  }
  const double room = plane->height + kSearchTolerance;
  return {(nearer - room) / fall, room < 0.0};
}

bool EndGuard::holds(const StretchMotion& motion) const {
  constexpr double kFarTurned = 0.05;  // plane_departure() holds up to here
  if (body_ == nullptr || motion.turn() > kFarTurned) return false;
  const ToolPose from = motion.at(0.0), to = motion.at(1.0);
  const std::optional<Plane> plane = touching(from);
  if (!plane) return false;
  const Vec3 m = end_ - from.tip;
  const double departure =
      motion.turn() == 0.0 ? 0.0
                           : motion.plane_departure(1.0, std::max(m.norm(), (end_ - to.tip).norm()),
                                                    (to.tip - from.tip).norm());
  if (!(plane->height + kSearchTolerance >= departure)) return false;
  const Vec3 n = plane->lateral * plane->side + plane->axial * from.axis;
  if (!(n.dot(beyond_) > 1.1 * motion.turn())) return false;
  const Vec3 turned = plane->side - plane->side.dot(to.axis) * to.axis;
  Vec3 n_to = plane->axial * to.axis;
  if (plane->lateral > 0.0) n_to += (plane->lateral / turned.norm()) * turned;
  return n_to.dot(end_ - to.tip) - plane->offset + kSearchTolerance >= departure;
}

}  // namespace frustum::cutter
