#include "cutter/search/separating_plane.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cutter/sweep/segment_sweep.hpp"

namespace frustum::cutter {
namespace {

// Nearer to the axis than this (mm) there is no meridian to speak of.
constexpr double kOnAxis = 1e-9;

// Axial part of the outward normal of a zone at one of its ends.
double axial_at(const Zone& zone, double height) {
  if (zone.kind == ZoneKind::cone) return -zone.slope / std::hypot(1.0, zone.slope);
  return std::clamp((height - zone.centre) / zone.radius, -1.0, 1.0);
}

// A round face, or an edge all round the section, and between which normals planes touch it there.
struct Round {
  Zone zone{};
  double least_axial = -1.0, most_axial = 1.0;
};

Round round_face(const Zone& zone) {
  return {zone, axial_at(zone, zone.z_lo), axial_at(zone, zone.z_hi)};
}

// The edge at the lower or upper end of a flat or conical zone, if it is not a point.
std::optional<Round> rim_of(std::span<const Zone> zones, std::size_t i, bool upper) {
  constexpr double kPoint = 1e-6;  // mm
  const Zone& zone = zones[i];
  const double height = upper ? zone.z_hi : zone.z_lo;
  const double radius = zone.radius + zone.slope * (height - zone.z_lo);
  if (radius <= kPoint) return std::nullopt;
  const double own = axial_at(zone, height);
  Round rim{torus_zone(radius, 0.0, height, height, height), own, own};
  if (upper) {
    rim.most_axial = i + 1 < zones.size() ? axial_at(zones[i + 1], height) : 1.0;
  } else {
    rim.least_axial = i > 0 ? axial_at(zones[i - 1], height) : -1.0;
  }
  return rim;
}

// Round faces as they are. At the flat ends, and near the edges of flanks, the edge: for the
// cutters for which the point is beside the face its plane turns towards the next one.
std::optional<Round> round_at(const Profile& section, const EndContact& end, const Vec3& point) {
  const auto zones = section.zones();
  const bool at_bottom = end.face == kBottomFace, at_top = end.face == kTopFace;
  const std::size_t zone = at_bottom ? 0
                           : at_top  ? zones.size() - 1
                                     : static_cast<std::size_t>(end.face);
  if (zones[zone].kind != ZoneKind::cone) {
    const Round face = round_face(zones[zone]);
    constexpr double kFlush = 1e-9;  // where a flat end goes on into the round face
    const bool is_kink = (at_bottom && face.least_axial > -1.0 + kFlush) ||
                         (at_top && face.most_axial < 1.0 - kFlush);
    return is_kink ? std::nullopt : std::optional(face);
  }
  if (at_bottom || at_top) return rim_of(zones, zone, at_top);
  const double near_by = 0.05 * section.max_radius();
  const double z = (point - end.pose.tip).dot(end.pose.axis);
  for (const bool upper : {false, true}) {
    const double height = upper ? zones[zone].z_hi : zones[zone].z_lo;
    if (std::abs(z - height) < near_by) return rim_of(zones, zone, upper);
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
  if (const auto round = round_at(section, end, end_)) {
    is_round_ = true;
    round_ = round->zone;
    least_axial_ = round->least_axial;
    most_axial_ = round->most_axial;
    return;
  }
  const Facing facing = section.facing(end.face, end.pose, end_, beyond_);
  axial_ = facing.axial;
  lateral_ = facing.lateral;
  offset_ = support(lateral_, axial_);
}

SeparatingPlane::SeparatingPlane(const Body& body, const Vec3& end, const Vec3& beyond,
                                 const Latitude& latitude)
    : body_(&body),
      end_(end),
      beyond_(beyond),
      axial_(latitude.axial),
      lateral_(latitude.lateral),
      offset_(support(lateral_, axial_)) {}

double SeparatingPlane::support(double lateral, double axial) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Profile& section : body_->sections())
    most = std::max(most, section.support(lateral, axial));
  return most;
}

SeparatingPlane::Planes SeparatingPlane::touching(const BothVec& m, const BothVec& axis) const {
  Planes at;
  const BothVec turned = m.cross(axis);
  const Both rho = square_root(turned.dot(turned));
  const Both z = m.dot(axis);
  at.across = (rho > kOnAxis ? 1.0 / rho : both(0.0)) * turned;
  Both offset = both(offset_);
  at.axial = both(axial_);
  at.lateral = both(lateral_);
  if (is_round_) {
    const Both beside =
        round_.major < 0.0 ? rho - round_.major : larger(rho - round_.major, both(0.0));
    const Both above = z - round_.centre;
    const Both length = square_root(beside * beside + above * above);
    // Towards the end; where the ray would come back to that plane, as much the other way.
    const Both up = axis.dot(both(beyond_));
    const Both out = (rho > kOnAxis ? 1.0 / rho : both(0.0)) * (m.dot(both(beyond_)) - z * up);
    const Both along = smaller(beside * out + above * up, both(0.0));
    const Both steep = out * out + up * up;
    const Both back = steep > kOnAxis ? 2.0 * along / steep : both(0.0);
    const Both wanted = (above - back * up) / length;
    at.axial = larger(smaller(wanted, both(most_axial_)), both(least_axial_));
    at.lateral = square_root(larger(1.0 - at.axial * at.axial, both(0.0)));
    offset = at.lateral * round_.major + at.axial * round_.centre + round_.radius;
    // A plane that touches a convex body where the round face is has all of the body on one side.
    if (!body_->is_convex()) {
      offset = Both{support(at.lateral[0], at.axial[0]), support(at.lateral[1], at.axial[1])};
    }
  }
  at.normal = at.lateral * axis.cross(at.across) + at.axial * axis;
  at.height = at.lateral * rho + at.axial * z - offset;
  return at;
}

BothVec SeparatingPlane::way_to_end(const BothVec& m, const BothVec& axis) const {
  const Both z = m.dot(axis);
  const BothVec across = m - z * axis;
  if (!is_round_) return across;
  const BothVec up = (z - round_.centre) * axis;
  if (round_.major == 0.0) return across + up;
  const Both rho = larger(square_root(across.dot(across)), both(kOnAxis));
  const Both beside =
      round_.major < 0.0 ? rho - round_.major : larger(rho - round_.major, both(0.0));
  return (beside / rho) * across + up;
}

Both SeparatingPlane::height_about(const BothVec& m, const BothVec& axis) const {
  const Both z = m.dot(axis);
  const BothVec across = m - z * axis;
  const Both rho = square_root(across.dot(across));
  if (!is_round_) return lateral_ * rho + axial_ * z - offset_;
  const Both beside =
      round_.major < 0.0 ? rho - round_.major : larger(rho - round_.major, both(0.0));
  const Both above = z - round_.centre;
  return square_root(beside * beside + above * above) - round_.radius;
}

PairPlanes SeparatingPlane::planes(const GroupPair& groups) const {
  const BothVec axis = both(groups.axis);
  const BothVec one = both(groups.first_column), two = both(groups.second_column);
  const BothVec three = one.cross(two);
  const Both half_1 = both(groups.tip_half[0]), half_2 = both(groups.tip_half[1]),
             half_3 = both(groups.tip_half[2]);
  const Both turn = both(groups.axis_shift);
  BothVec m = both(end_) - both(groups.tip);
  const Both in_the_middle = height_about(m, axis);
  // From the middle to the place in the box that is nearest to touching the end there.
  Both c_1 = both(0.0), c_2 = both(0.0), c_3 = both(0.0), went = both(0.0);
  if (is_round_ || lateral_ > 0.0) {
    const BothVec way = way_to_end(m, axis);
    const auto within = [](Both x, Both half) { return larger(smaller(x, half), -half); };
    c_1 = within(way.dot(one), half_1);
    c_2 = within(way.dot(two), half_2);
    c_3 = within(way.dot(three), half_3);
    m = m - (c_1 * one + c_2 * two + c_3 * three);
    went = magnitude(c_1) + magnitude(c_2) + magnitude(c_3);
  }
  const Planes at = touching(m, axis);
  const Both n_1 = at.normal.dot(one), n_2 = at.normal.dot(two), n_3 = at.normal.dot(three);
  Both lost = magnitude(n_1) * half_1 - n_1 * c_1 + magnitude(n_2) * half_2 - n_2 * c_2 +
              magnitude(n_3) * half_3 - n_3 * c_3;
  if (turn[0] > 0.0 || turn[1] > 0.0) {
    const BothVec by_axis = at.lateral * at.across.cross(m) + at.axial * m;
    constexpr double kColumns = 1.000001;  // of the frame are units within 1e-7
    lost = lost + magnitude(by_axis.dot(one)) * both(groups.axis_half[0]) +
           magnitude(by_axis.dot(two)) * both(groups.axis_half[1]) +
           magnitude(by_axis.dot(three)) * both(groups.axis_half[2]) + both(groups.tip_turn) +
           kColumns * went * turn;
  }
  return {at.normal, at.height, lost, turn, in_the_middle};
}

Overreach SeparatingPlane::overreach(const GroupPair& groups, double slack) const {
  if (body_ == nullptr) return {};
  const PairPlanes at = planes(groups);
  const Both fall = at.normal.dot(both(beyond_)) - at.turn;
  const Both infinite = both(std::numeric_limits<double>::infinity());
  const Both height = at.height + slack;
  constexpr double kRounding = 1e-12;  // mm
  return {fall > 0.0 ? (at.lost - height) / fall : infinite, at.in_the_middle, kRounding / fall};
}

double SeparatingPlane::along(const ToolPose& pose) const {
  if (body_ == nullptr) return 0.0;
  return touching(both(end_ - pose.tip), both(pose.axis)).normal.dot(both(beyond_))[0];
}

double SeparatingPlane::room(const ToolPose& from, const ToolPose& to, double slack) const {
  constexpr double kUnknown = -std::numeric_limits<double>::infinity();
  if (body_ == nullptr) return kUnknown;
  const auto lanes = [](const Vec3& a, const Vec3& b) {
    return BothVec{{a.x(), b.x()}, {a.y(), b.y()}, {a.z(), b.z()}};
  };
  const BothVec m = lanes(end_ - from.tip, end_ - to.tip);
  const Planes at = touching(m, lanes(from.axis, to.axis));
  const Both height = at.height + slack;
  const double lower = std::min(height[0], height[1]);
  if (lower < 0.0) return lower;
  const Vec3 step = to.tip - from.tip, turn = to.axis - from.axis;
  // What the height loses by a straight line from either end to the other, and by turning.
  Both lost = Both{1.0, -1.0} * at.normal.dot(both(step));
  double bend = 0.0, chord = 0.0;
  if (turn != Vec3::Zero()) {
    constexpr double kFarTurned = 0.05;
    const double chord2 = turn.squaredNorm();
    if (chord2 > kFarTurned * kFarTurned) return kUnknown;
    chord = std::sqrt(chord2);
    const BothVec by_axis = at.lateral * at.across.cross(m) + at.axial * m;
    lost = lost - Both{1.0, -1.0} * by_axis.dot(both(turn)) + step.norm() * chord;
    // From its chord the axis is never farther than turn^2 / 8, and 1.01 is more than the turn has
    // over the chord.
    const Vec3 from_tip = end_ - from.tip;
    bend = 1.01 / 8.0 * chord2 * (from_tip.norm() + 2.0 * step.norm());
  }
  const Both fall = at.normal.dot(both(beyond_));
  if (!(fall[0] > chord) || !(fall[1] > chord)) return kUnknown;
  const double here = height[0] - bend, here_there = here - lost[0];
  const double there = height[1] - bend, there_here = there - lost[1];
  if (here < 0.0 || there < 0.0) return std::min(here, there);
  if (here_there >= 0.0 || there_here >= 0.0) return 0.0;
  // Each line falls below 0 before the other end: where they meet it must not be so.
  const double meet = here * there - here_there * there_here;
  return meet >= 0.0 ? 0.0 : std::max(here_there, there_here);
}

}  // namespace frustum::cutter
