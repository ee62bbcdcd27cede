#include "cutter/search/separating_plane.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cutter/sweep/segment_sweep.hpp"

namespace frustum::cutter {
namespace {

// Nearer to the axis than this (mm) there is no meridian to speak of.
constexpr double kOnAxis = 1e-9;

// Motions that turn by more have no proof (rad).
constexpr double kFarTurned = 0.1;
// From its chord the axis is never farther than turn^2 / 8, and 1.01 is more than the turn has over
// the chord.
constexpr double kAxisBend = 1.01 / 8.0;

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

// Of two cutters, or of groups side by side.
template <class Lanes>
struct SeparatingPlane::OfLanes {
  using LaneVec = LanesVec<Lanes>;

  FRUSTUM_OF_LANES static Lanes all(double x) { return lanes_of<Lanes>(x); }
  FRUSTUM_OF_LANES static LaneVec all(const Vec3& v) { return vec_of<Lanes>(v); }

  // The planes towards the end, which is at `m` from the tips.
  struct Planes {
    Lanes axial, lateral;
    LaneVec across;  // unit vectors across the meridians
    LaneVec normal;
    Lanes height;  // of the end above the plane
  };
  FRUSTUM_OF_LANES static Planes touching(const SeparatingPlane& plane, const LaneVec& m,
                                          const LaneVec& axis) {
    Planes at;
    const LaneVec turned = m.cross(axis);
    const Lanes rho = square_root(turned.dot(turned));
    const Lanes z = m.dot(axis);
    const Lanes per_rho = rho > kOnAxis ? 1.0 / rho : all(0.0);
    at.across = per_rho * turned;
    Lanes offset = all(plane.offset_);
    at.axial = all(plane.axial_);
    at.lateral = all(plane.lateral_);
    if (plane.is_round_) {
      const Zone& round = plane.round_;
      const Lanes above = z - round.centre, beside = beside_circle(round, rho);
      const Lanes length = square_root(beside * beside + above * above);
      // Towards the end; where the ray would come back to that plane, as much the other way.
      const LaneVec beyond = all(plane.beyond_);
      const Lanes up = axis.dot(beyond);
      const Lanes out = per_rho * (m.dot(beyond) - z * up);
      const Lanes along = smaller(beside * out + above * up, all(0.0));
      const Lanes steep = out * out + up * up;
      const Lanes back = steep > kOnAxis ? 2.0 * along / steep : all(0.0);
      const Lanes wanted = (above - back * up) / length;
      at.axial = larger(smaller(wanted, all(plane.most_axial_)), all(plane.least_axial_));
      at.lateral = square_root(larger(1.0 - at.axial * at.axial, all(0.0)));
      offset = at.lateral * round.major + at.axial * round.centre + round.radius;
      // A plane that touches a convex body where the round face is has all of the body on one side.
      if (!plane.body_->is_convex()) {
        for (std::size_t k = 0; k < kLanes<Lanes>; ++k)
          offset[k] = plane.support(at.lateral[k], at.axial[k]);
      }
    }
    at.normal = at.lateral * axis.cross(at.across) + at.axial * axis;
    at.height = at.lateral * rho + at.axial * z - offset;
    return at;
  }

  FRUSTUM_OF_LANES static Lanes beside_circle(const Zone& round, Lanes rho) {
    const Lanes beside = rho - round.major;
    return round.major < 0.0 ? beside : larger(beside, all(0.0));
  }

  // From the tip to where it is nearest to the end, as if it could go anywhere.
  FRUSTUM_OF_LANES static LaneVec way_to_end(const SeparatingPlane& plane, const LaneVec& m,
                                             const LaneVec& axis) {
    const Lanes z = m.dot(axis);
    const LaneVec across = m - z * axis;
    if (!plane.is_round_) return across;
    const LaneVec up = (z - plane.round_.centre) * axis;
    if (plane.round_.major == 0.0) return across + up;
    const Lanes rho = larger(square_root(across.dot(across)), all(kOnAxis));
    return (beside_circle(plane.round_, rho) / rho) * across + up;
  }

  // Of the end above the plane of a cutter, about.
  FRUSTUM_OF_LANES static Lanes height_about(const SeparatingPlane& plane, const LaneVec& m,
                                             const LaneVec& axis) {
    const Lanes z = m.dot(axis);
    const LaneVec across = m - z * axis;
    const Lanes rho = square_root(across.dot(across));
    if (!plane.is_round_) return plane.lateral_ * rho + plane.axial_ * z - plane.offset_;
    const Lanes above = z - plane.round_.centre, beside = beside_circle(plane.round_, rho);
    return square_root(beside * beside + above * above) - plane.round_.radius;
  }

  // As QuadPlanes has them, and about the height over the plane of a cutter in the middle.
  struct GroupPlanes {
    LaneVec normal;
    Lanes height, lost, turn, in_the_middle;
  };
  FRUSTUM_OF_LANES static GroupPlanes of_groups(const SeparatingPlane& plane,
                                                const GroupQuad& groups, std::size_t from) {
    const LaneVec axis = vec_of<Lanes>(groups.axis, from);
    const LaneVec one = vec_of<Lanes>(groups.first_column, from),
                  two = vec_of<Lanes>(groups.second_column, from);
    const LaneVec three = one.cross(two);
    const LaneVec half = vec_of<Lanes>(groups.tip_half, from);
    const Lanes turn = lanes_of<Lanes>(groups.axis_shift, from);
    LaneVec m = all(plane.end_) - vec_of<Lanes>(groups.tip, from);
    const Lanes in_the_middle = height_about(plane, m, axis);
    // From the middle to the place in the box that is nearest to touching the end there.
    LaneVec to{};
    if (plane.is_round_ || plane.lateral_ > 0.0) {
      const LaneVec way = way_to_end(plane, m, axis);
      to = {within(way.dot(one), half.x), within(way.dot(two), half.y),
            within(way.dot(three), half.z)};
      m = m - (to.x * one + to.y * two + to.z * three);
    }
    const Planes at = touching(plane, m, axis);
    const LaneVec n{at.normal.dot(one), at.normal.dot(two), at.normal.dot(three)};
    Lanes lost = magnitude(n.x) * half.x - n.x * to.x + magnitude(n.y) * half.y - n.y * to.y +
                 magnitude(n.z) * half.z - n.z * to.z;
    bool turns = false;
    for (std::size_t k = 0; k < kLanes<Lanes>; ++k) turns = turns || turn[k] > 0.0;
    if (turns) {
      const LaneVec by_axis = at.lateral * at.across.cross(m) + at.axial * m;
      const LaneVec axis_half = vec_of<Lanes>(groups.axis_half, from);
      const Lanes went = magnitude(to.x) + magnitude(to.y) + magnitude(to.z);
      constexpr double kColumns = 1.000001;  // of the frame are units within 1e-7
      lost = lost + magnitude(by_axis.dot(one)) * axis_half.x +
             magnitude(by_axis.dot(two)) * axis_half.y +
             magnitude(by_axis.dot(three)) * axis_half.z + lanes_of<Lanes>(groups.tip_turn, from) +
             kColumns * went * turn;
    }
    return {at.normal, at.height, lost, turn, in_the_middle};
  }
  FRUSTUM_OF_LANES static void planes(const SeparatingPlane& plane, const GroupQuad& groups,
                                      std::size_t from, QuadPlanes& all) {
    const GroupPlanes at = of_groups(plane, groups, from);
    store(at.normal.x, from, all.normal[0]);
    store(at.normal.y, from, all.normal[1]);
    store(at.normal.z, from, all.normal[2]);
    store(at.height, from, all.height);
    store(at.lost, from, all.lost);
    store(at.turn, from, all.turn);
  }
  FRUSTUM_OF_LANES static void overreach(const SeparatingPlane& plane, const GroupQuad& groups,
                                         double slack, std::size_t from, Overreach& over) {
    const GroupPlanes at = of_groups(plane, groups, from);
    const Lanes fall = at.normal.dot(all(plane.beyond_)) - at.turn;
    const Lanes height = at.height + slack;
    constexpr double kRounding = 1e-12;  // mm
    store(fall > 0.0 ? (at.lost - height) / fall : all(std::numeric_limits<double>::infinity()),
          from, over.most);
    store(at.in_the_middle, from, over.height);
    store(kRounding / fall, from, over.rounding);
  }

  // What the height over a plane loses by a straight motion, and by turning.
  FRUSTUM_OF_LANES static Lanes lost(const Planes& at, const LaneVec& m, const LaneVec& step,
                                     const LaneVec& turn) {
    const LaneVec by_axis = at.lateral * at.across.cross(m) + at.axial * m;
    return at.normal.dot(step) - by_axis.dot(turn);
  }
  // As SeparatingPlane::room().
  FRUSTUM_OF_LANES static void rooms(const SeparatingPlane& plane, const MotionFour& motions,
                                     double slack, std::size_t from, DoubleFour& rooms) {
    const LaneVec from_tip = vec_of<Lanes>(motions.from_tip, from),
                  from_axis = vec_of<Lanes>(motions.from_axis, from),
                  to_tip = vec_of<Lanes>(motions.to_tip, from),
                  to_axis = vec_of<Lanes>(motions.to_axis, from);
    const LaneVec end = all(plane.end_), beyond = all(plane.beyond_);
    const LaneVec m_here = end - from_tip, m_there = end - to_tip;
    const Planes at_here = touching(plane, m_here, from_axis);
    const Planes at_there = touching(plane, m_there, to_axis);
    const LaneVec step = to_tip - from_tip, turn = to_axis - from_axis;
    const Lanes way = square_root(step.dot(step)), chord2 = turn.dot(turn);
    const Lanes chord = square_root(chord2);
    const Lanes bend = kAxisBend * chord2 * (square_root(m_here.dot(m_here)) + 2.0 * way);
    const Lanes height_here = at_here.height + slack, height_there = at_there.height + slack;
    const Lanes here = height_here - bend, there = height_there - bend;
    const Lanes here_there = here - way * chord - lost(at_here, m_here, step, turn);
    const Lanes there_here = there - way * chord + lost(at_there, m_there, step, turn);
    const Lanes best = larger(here_there, there_here), least = smaller(here, there);
    const Lanes none = all(0.0), unknown = all(-std::numeric_limits<double>::infinity());
    Lanes room = here * there - here_there * there_here >= none ? none : best;
    room = best >= none ? none : room;
    room = least < none ? least : room;
    room = at_here.normal.dot(beyond) > chord ? room : unknown;
    room = at_there.normal.dot(beyond) > chord ? room : unknown;
    room = chord2 > all(kFarTurned * kFarTurned) ? unknown : room;
    const Lanes lower = smaller(height_here, height_there);
    store(lower < none ? lower : room, from, rooms);
  }
};

#ifdef FRUSTUM_HAS_FOUR_LANES
FRUSTUM_FOUR_LANES void SeparatingPlane::rooms_four(const MotionFour& motions, double slack,
                                                    DoubleFour& rooms) const {
  OfLanes<Four>::rooms(*this, motions, slack, 0, rooms);
}
FRUSTUM_FOUR_LANES void SeparatingPlane::planes_four(const GroupQuad& groups,
                                                     QuadPlanes& all) const {
  OfLanes<Four>::planes(*this, groups, 0, all);
}
FRUSTUM_FOUR_LANES void SeparatingPlane::overreach_four(const GroupQuad& groups, double slack,
                                                        Overreach& over) const {
  OfLanes<Four>::overreach(*this, groups, slack, 0, over);
}
#endif

QuadPlanes SeparatingPlane::planes(const GroupQuad& groups,
                                   [[maybe_unused]] LaneChoice lanes) const {
  QuadPlanes all;
#ifdef FRUSTUM_HAS_FOUR_LANES
  if (has_four_lanes(lanes)) {
    planes_four(groups, all);
    return all;
  }
#endif
  OfLanes<Both>::planes(*this, groups, 0, all);
  OfLanes<Both>::planes(*this, groups, 2, all);
  return all;
}

Overreach SeparatingPlane::overreach(const GroupQuad& groups, double slack,
                                     [[maybe_unused]] LaneChoice lanes) const {
  if (body_ == nullptr) return {};
  Overreach over;
#ifdef FRUSTUM_HAS_FOUR_LANES
  if (has_four_lanes(lanes)) {
    overreach_four(groups, slack, over);
    return over;
  }
#endif
  OfLanes<Both>::overreach(*this, groups, slack, 0, over);
  OfLanes<Both>::overreach(*this, groups, slack, 2, over);
  return over;
}

DoubleFour SeparatingPlane::rooms(const MotionFour& motions, double slack,
                                  [[maybe_unused]] LaneChoice lanes) const {
  if (body_ == nullptr) return four_of(-std::numeric_limits<double>::infinity());
  DoubleFour rooms;
#ifdef FRUSTUM_HAS_FOUR_LANES
  if (has_four_lanes(lanes)) {
    rooms_four(motions, slack, rooms);
    return rooms;
  }
#endif
  OfLanes<Both>::rooms(*this, motions, slack, 0, rooms);
  OfLanes<Both>::rooms(*this, motions, slack, 2, rooms);
  return rooms;
}

double SeparatingPlane::along(const ToolPose& pose) const {
  if (body_ == nullptr) return 0.0;
  using Pose = OfLanes<Both>;
  return Pose::touching(*this, Pose::all(end_ - pose.tip), Pose::all(pose.axis))
      .normal.dot(Pose::all(beyond_))[0];
}

double SeparatingPlane::room(const ToolPose& from, const ToolPose& to, double slack) const {
  constexpr double kUnknown = -std::numeric_limits<double>::infinity();
  if (body_ == nullptr) return kUnknown;
  using Poses = OfLanes<Both>;
  const auto lanes = [](const Vec3& a, const Vec3& b) {
    return LanesVec<Both>{{a.x(), b.x()}, {a.y(), b.y()}, {a.z(), b.z()}};
  };
  const LanesVec<Both> m = lanes(end_ - from.tip, end_ - to.tip);
  const Poses::Planes at = Poses::touching(*this, m, lanes(from.axis, to.axis));
  const Both height = at.height + slack;
  const double lower = std::min(height[0], height[1]);
  if (lower < 0.0) return lower;
  const Vec3 step = to.tip - from.tip, turn = to.axis - from.axis;
  // What the height loses by a straight line from either end to the other, and by turning.
  Both lost = Both{1.0, -1.0} * at.normal.dot(Poses::all(step));
  double bend = 0.0, chord = 0.0;
  if (turn != Vec3::Zero()) {
    const double chord2 = turn.squaredNorm();
    if (chord2 > kFarTurned * kFarTurned) return kUnknown;
    chord = std::sqrt(chord2);
    const LanesVec<Both> by_axis = at.lateral * at.across.cross(m) + at.axial * m;
    lost = lost - Both{1.0, -1.0} * by_axis.dot(Poses::all(turn)) + step.norm() * chord;
    const Vec3 from_tip = end_ - from.tip;
    bend = kAxisBend * chord2 * (from_tip.norm() + 2.0 * step.norm());
  }
  const Both fall = at.normal.dot(Poses::all(beyond_));
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
