#include "cutter/body/profile.hpp"
#include "core/constants.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace frustum::cutter {
namespace {

// The ray in the tool's cylindrical terms, counted from a place near the cutter, where nothing
// cancels: rho^2 = rho2 + 2 bend u + v2 u^2 and z = z0 + dz u at s = s0 + u.
struct ToolRay {
  double s0 = 0.0;
  double rho2 = 0.0;
  double bend = 0.0;
  double v2 = 0.0;
  double z0 = 0.0;
  double dz = 0.0, per_dz = 0.0;
  Vec3 w0 = Vec3::Zero(), v = Vec3::Zero();  // across the axis: the place, and the way along s
};

ToolRay in_tool_terms(const ToolPose& pose, const Ray& ray, double middle) {
  const Vec3 m = ray.origin - pose.tip;
  const double mz = m.dot(pose.axis);
  const double dz = ray.direction.dot(pose.axis);
  const Vec3 w = m - mz * pose.axis;
  const Vec3 v = ray.direction - dz * pose.axis;
  const double v2 = v.squaredNorm();
  // At small angles to the axis the nearest point to it is far away, where numbers are large: count
  // from the middle of the cutter. The square of the sine: from 11.5 degrees on it is within five
  // times the distance from the axis.
  constexpr double kNearlyAlong = 0.04;
  const bool along = v2 < kNearlyAlong;
  const double s0 = along ? (middle - mz) / dz : -w.dot(v) / v2;
  const Vec3 w0 = w + s0 * v;
  return {s0, w0.squaredNorm(), along ? w0.dot(v) : 0.0, v2, mz + s0 * dz, dz, 1.0 / dz, w0, v};
}

struct Span {
  double lo = -kInfinity;
  double hi = kInfinity;

  [[nodiscard]] bool empty() const { return !(lo <= hi); }
};
constexpr Span kNothing{1.0, 0.0};

Span overlap(const Span& a, const Span& b) { return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)}; }

// z_lo <= z0 + dz u <= z_hi.
Span slab_span(const ToolRay& ray, double z_lo, double z_hi) {
  if (ray.dz == 0.0) return ray.z0 < z_lo || ray.z0 > z_hi ? kNothing : Span{};
  const double a = (z_lo - ray.z0) * ray.per_dz;
  const double b = (z_hi - ray.z0) * ray.per_dz;
  return {std::min(a, b), std::max(a, b)};
}

// a u^2 + 2 b u + c <= 0 for a > 0; disc is b^2 - a c.
Span below_parabola(double a, double b, double c, double disc) {
  if (b == 0.0) {
    const double half2 = -c / a;
    if (half2 < 0.0) return kNothing;
    const double half = std::sqrt(half2);
    return {-half, half};
  }
  if (disc < 0.0) return kNothing;
  const double q = -(b + std::copysign(std::sqrt(disc), b));
  if (q == 0.0) return {0.0, 0.0};
  const double one = q / a, other = c / q;
  return {std::min(one, other), std::max(one, other)};
}

Span below_parabola(double a, double b, double c) { return below_parabola(a, b, c, b * b - a * c); }

// rho <= radius.
Span cylinder_span(const ToolRay& ray, double radius) {
  const double c = ray.rho2 - radius * radius;
  // Below (1e-15)^2 the ray is parallel to the axis within rounding: inside for ever, or never.
  if (ray.v2 < 1e-30) return c > 0.0 ? kNothing : Span{};
  return below_parabola(ray.v2, ray.bend, c);
}

// rho <= radius + slope (z - z_lo), where the right side is positive.
Span cone_span(const ToolRay& ray, double radius, double slope, double z_lo) {
  const double r0 = radius + slope * (ray.z0 - z_lo);
  const double e = slope * ray.dz;
  const double a = ray.v2 - e * e;
  const double b = ray.bend - r0 * e;
  const double c = ray.rho2 - r0 * r0;
  const double scale = ray.v2 + e * e;
  if (scale < 1e-30) return c > 0.0 || r0 < 0.0 ? kNothing : Span{};
  // b^2 - a c, so that nothing cancels for rays along the axis or by the apex; what is counted from
  // the nearest point to the axis has w0.v = 0.
  const double disc =
      ray.bend == 0.0 ? ray.v2 * (r0 * r0 - ray.rho2) + e * e * ray.rho2
                      : (r0 * ray.v - e * ray.w0).squaredNorm() - ray.w0.cross(ray.v).squaredNorm();
  // The ray is steeper than the flank (or as steep): it stays inside once it is.
  if (a <= 1e-14 * scale) {
    const double q = -(b + std::copysign(std::sqrt(std::max(0.0, disc)), b));
    if (q == 0.0 && c > 0.0) return kNothing;  // along a flank, and beside it
    if (q == 0.0) return e > 0.0 ? Span{0.0, kInfinity} : Span{-kInfinity, 0.0};  // by the apex
    const double near = c / q;
    const double far = std::abs(a) <= 1e-14 * scale ? std::copysign(kInfinity, q) : q / a;
    // Of the two half-lines outside the roots the one on the cone's own side of its apex.
    const double lower = std::min(near, far), upper = std::max(near, far);
    if (std::isinf(far)) {
      // Along a flank: inside from the root on, or beyond the apex and never of this cone.
      if ((far > 0.0) != (e > 0.0)) return kNothing;
      return e > 0.0 ? Span{near, kInfinity} : Span{-kInfinity, near};
    }
    return e > 0.0 ? Span{upper, kInfinity} : Span{-kInfinity, lower};
  }
  const Span both = below_parabola(a, b, c, disc);
  if (both.empty()) return both;
  return r0 + e * 0.5 * (both.lo + both.hi) < 0.0 ? kNothing : both;
}

// rho^2 + (z - centre)^2 <= radius^2.
Span sphere_span(const ToolRay& ray, double radius, double centre) {
  const double h = ray.z0 - centre;
  const double a = ray.v2 + ray.dz * ray.dz;
  const double b = ray.bend + h * ray.dz;
  if (ray.bend == 0.0) {
    // About the nearest point: rho2 + h^2 (1 - dz^2 / a) is the square of the least distance.
    const double miss2 = ray.rho2 + h * h * (ray.v2 / a);
    const double half2 = (radius * radius - miss2) / a;
    if (half2 < 0.0) return kNothing;
    const double half = std::sqrt(half2);
    return {-b / a - half, -b / a + half};
  }
  return below_parabola(a, b, ray.rho2 + h * h - radius * radius);
}

// How far a point is from the circle of a torus across the axis. Inside the circle of an ordinary
// torus the tube's height alone counts; of a lens (negative major radius) the outer side is all
// there is.
double beside_circle(double rho, double major) {
  return major < 0.0 ? rho - major : std::max(0.0, rho - major);
}

// The points within `tube` of the circle, or of the disc in it, inside `within`. The squared
// distance is a convex function of u, so Newton's steps from outside never pass the end.
Span torus_span(const ToolRay& ray, double major, double tube, double centre, const Span& within) {
  const Span outer = overlap(cylinder_span(ray, major + tube), within);
  if (outer.empty()) return kNothing;
  const auto end = [&](double u, double inward) -> double {
    for (int i = 0; i < 100; ++i) {
      const double rho2 = std::max(0.0, ray.rho2 + u * (2.0 * ray.bend + u * ray.v2));
      const double rho = std::sqrt(rho2);
      const double h = ray.z0 - centre + u * ray.dz;
      const double over = beside_circle(rho, major);
      const double excess = over * over + h * h - tube * tube;
      if (excess <= 0.0) return u;
      const double lateral = over > 0.0 && rho > 0.0 ? over * (ray.bend + u * ray.v2) / rho : 0.0;
      const double fall = -2.0 * inward * (lateral + h * ray.dz);
      if (!(fall > 0.0)) return kInfinity;  // it rises and is still outside: no end this way
      const double step = excess / fall;
      const double next = u + inward * step;
      if (next == u || step < 1e-15 * (1.0 + std::abs(u))) return u;
      u = next;
    }
    return u;
  };
  if (std::isinf(outer.lo) || std::isinf(outer.hi)) {
    // Along the axis: rho is constant, and so the height limits alone.
    const double rho = std::sqrt(std::max(0.0, ray.rho2));
    const double over = beside_circle(rho, major);
    if (over > tube) return kNothing;
    const double half = std::sqrt(tube * tube - over * over);
    return overlap(slab_span(ray, centre - half, centre + half), within);
  }
  const double lo = end(outer.lo, 1.0);
  if (std::isinf(lo) || lo > outer.hi) return kNothing;
  const double hi = end(outer.hi, -1.0);
  if (std::isinf(hi) || hi < lo) return kNothing;
  // Where the limit is met inside the tube, the tube goes on beyond it.
  return {lo == within.lo ? -kInfinity : lo, hi == within.hi ? kInfinity : hi};
}

// The lateral surface alone, grown outwards; `within` bounds where it is asked for.
Span lateral_span(const Zone& zone, double secant, const ToolRay& ray, double grown_by,
                  const Span& within) {
  switch (zone.kind) {
    case ZoneKind::cone:
      if (zone.slope == 0.0) return cylinder_span(ray, zone.radius + grown_by);
      return cone_span(ray, zone.radius + grown_by * secant, zone.slope, zone.z_lo);
    case ZoneKind::sphere:
      return sphere_span(ray, zone.radius + grown_by, zone.centre);
    case ZoneKind::torus:
      return torus_span(ray, zone.major, zone.radius + grown_by, zone.centre, within);
  }
  return kNothing;
}

double radius_at(const Zone& zone, double z) {
  const double h = z - zone.centre;
  switch (zone.kind) {
    case ZoneKind::cone:
      return std::max(0.0, zone.radius + zone.slope * (z - zone.z_lo));
    case ZoneKind::sphere:
      return std::sqrt(std::max(0.0, zone.radius * zone.radius - h * h));
    case ZoneKind::torus:
      return zone.major + std::sqrt(std::max(0.0, zone.radius * zone.radius - h * h));
  }
  return 0.0;
}

// The generatrix's point that is farthest in the direction (across, u) of the half-plane.
double zone_support(const Zone& zone, double across, double u) {
  double z = u > 0.0 ? zone.z_hi : zone.z_lo;
  if (zone.kind == ZoneKind::cone) {
    z = u + zone.slope * across > 0.0 ? zone.z_hi : zone.z_lo;
  } else {
    const double length = std::sqrt(across * across + u * u);
    if (length > 0.0) z = std::clamp(zone.centre + zone.radius * u / length, zone.z_lo, zone.z_hi);
  }
  return z * u + radius_at(zone, z) * across;
}

}  // namespace

Zone cone_zone(double radius_lo, double radius_hi, double z_lo, double z_hi) {
  return {.kind = ZoneKind::cone,
          .z_lo = z_lo,
          .z_hi = z_hi,
          .radius = radius_lo,
          .slope = (radius_hi - radius_lo) / (z_hi - z_lo)};
}
Zone sphere_zone(double radius, double centre, double z_lo, double z_hi) {
  return {.kind = ZoneKind::sphere, .z_lo = z_lo, .z_hi = z_hi, .radius = radius, .centre = centre};
}
Zone torus_zone(double major, double minor, double centre, double z_lo, double z_hi) {
  return {.kind = ZoneKind::torus,
          .z_lo = z_lo,
          .z_hi = z_hi,
          .radius = minor,
          .centre = centre,
          .major = major};
}

Profile::Profile(std::vector<Zone> zones) : zones_(std::move(zones)) {
  assert(!zones_.empty());
  bottom_ = zones_.front().z_lo;
  height_ = zones_.back().z_hi;
  for (const Zone& zone : zones_) {
    secants_.push_back(std::hypot(1.0, zone.slope));
    for (const double z : {zone.z_lo, zone.z_hi}) {
      max_radius_ = std::max(max_radius_, radius_at(zone, z));
      reach_ = std::max(reach_, std::hypot(z, radius_at(zone, z)));
    }
    if (zone.kind == ZoneKind::cone) continue;
    // The belly of a sphere or torus may be between its two heights.
    if (zone.centre >= zone.z_lo && zone.centre <= zone.z_hi) {
      max_radius_ = std::max(max_radius_, zone.major + zone.radius);
    }
    reach_ = std::max(reach_, std::hypot(zone.major, zone.centre) + zone.radius);
  }
}

std::optional<Chord> Profile::chord(const ToolPose& pose, const Ray& ray, double grown_by) const {
  const ToolRay tool_ray = in_tool_terms(pose, ray, 0.5 * (bottom_ + height_));
  const Span slab = slab_span(tool_ray, bottom_ - grown_by, height_ + grown_by);
  if (slab.empty()) return std::nullopt;
  const bool has_zones = zones_.size() > 1;
  if (has_zones && overlap(slab, cylinder_span(tool_ray, max_radius_ + grown_by)).empty())
    return std::nullopt;

  const ProfileFace at_slab_lo = tool_ray.dz > 0.0 ? kBottomFace : kTopFace;
  const ProfileFace at_slab_hi = tool_ray.dz > 0.0 ? kTopFace : kBottomFace;
  Chord all{kInfinity, -kInfinity};
  for (std::size_t i = 0; i < zones_.size(); ++i) {
    const Zone& zone = zones_[i];
    const Span height =
        !has_zones ? slab : slab_span(tool_ray, zone.z_lo - grown_by, zone.z_hi + grown_by);
    if (height.empty()) continue;
    const Span lateral = lateral_span(zone, secants_[i], tool_ray, grown_by, height);
    const Span part = overlap(lateral, height);
    if (part.empty()) continue;
    const auto face = static_cast<ProfileFace>(i);
    if (part.lo < all.lo) {
      all.lo = part.lo;
      all.lo_face = part.lo == slab.lo && lateral.lo < slab.lo ? at_slab_lo : face;
    }
    if (part.hi > all.hi) {
      all.hi = part.hi;
      all.hi_face = part.hi == slab.hi && lateral.hi > slab.hi ? at_slab_hi : face;
    }
  }
  if (!(all.lo <= all.hi)) return std::nullopt;
  all.lo += tool_ray.s0;
  all.hi += tool_ray.s0;
  return all;
}

double Profile::support(double u) const {
  return support(std::sqrt(std::max(0.0, 1.0 - u * u)), u);
}

double Profile::support(double across, double u) const {
  double best = -kInfinity;
  for (const Zone& zone : zones_) best = std::max(best, zone_support(zone, across, u));
  return best;
}

Facing Profile::facing(ProfileFace face, const ToolPose& pose, const Vec3& point,
                       const Vec3& towards) const {
  const Vec3 m = point - pose.tip;
  const double z = m.dot(pose.axis);
  const Vec3 across = m - z * pose.axis;
  const double rho = across.norm();
  const bool on_axis = rho < 1e-12;
  Facing facing{.side = on_axis ? perpendicular_to(pose.axis) : Vec3(across / rho)};
  if (face == kTopFace) return facing;
  facing.axial = -1.0;
  if (face == kBottomFace) return facing;
  const auto index = static_cast<std::size_t>(face);
  const Zone& zone = zones_[index];
  if (zone.kind == ZoneKind::cone) {
    const double lateral = 1.0 / secants_[index], axial = -zone.slope * lateral;
    if (on_axis) {
      facing.axial = zone.slope < 0.0 ? 1.0 : -1.0;
      const double up = towards.dot(pose.axis);
      const Vec3 sideways = towards - up * pose.axis;
      const double leaning = sideways.norm();
      if (!(leaning > 0.0) || lateral * leaning + axial * up <= facing.axial * up) return facing;
      facing.side = sideways / leaning;
    }
    facing.lateral = lateral;
    facing.axial = axial;
    return facing;
  }
  const double beside = beside_circle(rho, zone.major), above = z - zone.centre;
  const double length = std::sqrt(beside * beside + above * above);
  if (length == 0.0) return facing;
  facing.lateral = beside / length;
  facing.axial = above / length;
  return facing;
}

Vec3 Profile::normal_of(ProfileFace face, const ToolPose& pose, const Vec3& point) const {
  const Facing at = facing(face, pose, point);
  return at.lateral * at.side + at.axial * pose.axis;
}

}  // namespace frustum::cutter
