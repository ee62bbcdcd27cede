#include "cutter/profile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace frustum::cutter {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The ray in the tool's cylindrical terms: m(s) = w + s v across the axis, z(s) = mz + s dz along it.
struct ToolRay {
  Vec3 w;
  Vec3 v;
  double mz;
  double dz;
};

ToolRay in_tool_terms(const ToolPose& pose, const Ray& ray) {
  const Vec3 m = ray.origin - pose.tip;
  const double mz = m.dot(pose.axis);
  const double dz = ray.direction.dot(pose.axis);
  return {m - mz * pose.axis, ray.direction - dz * pose.axis, mz, dz};
}

std::optional<Chord> overlap(const Chord& a, const Chord& b) {
  const Chord both{std::max(a.lo, b.lo), std::min(a.hi, b.hi)};
  if (both.lo > both.hi) return std::nullopt;
  return both;
}

// z_lo <= mz + s dz <= z_hi.
std::optional<Chord> slab_chord(const ToolRay& ray, double z_lo, double z_hi) {
  if (ray.dz == 0.0) {
    if (ray.mz < z_lo || ray.mz > z_hi) return std::nullopt;
    return Chord{-kInfinity, kInfinity};
  }
  const double a = (z_lo - ray.mz) / ray.dz;
  const double b = (z_hi - ray.mz) / ray.dz;
  return Chord{std::min(a, b), std::max(a, b)};
}

// |start + s step| <= radius, solved about the point of closest approach, where nothing cancels.
std::optional<Chord> ball_chord(const Vec3& start, const Vec3& step, double radius) {
  const double speed2 = step.squaredNorm();
  // Below (1e-15)^2 the ray is parallel to the axis within rounding: inside for ever, or never.
  if (speed2 < 1e-30) {
    if (start.squaredNorm() > radius * radius) return std::nullopt;
    return Chord{-kInfinity, kInfinity};
  }
  const double nearest = -start.dot(step) / speed2;
  const double miss2 = (start + nearest * step).squaredNorm();
  const double half2 = (radius * radius - miss2) / speed2;
  if (half2 < 0.0) return std::nullopt;
  const double half = std::sqrt(half2);
  return Chord{nearest - half, nearest + half};
}

std::optional<Chord> zone_chord(const Zone& zone, const ToolPose& pose, const ToolRay& ray,
                                double grown_by) {
  const auto slab = slab_chord(ray, zone.z_lo - grown_by, zone.z_hi + grown_by);
  if (!slab) return std::nullopt;
  std::optional<Chord> lateral;
  if (const auto* cylinder = std::get_if<CylinderZone>(&zone.shape)) {
    lateral = ball_chord(ray.w, ray.v, cylinder->radius + grown_by);
  } else {
    const auto& sphere = std::get<SphereZone>(zone.shape);
    const Vec3 start = ray.w + (ray.mz - sphere.centre) * pose.axis;
    lateral = ball_chord(start, ray.v + ray.dz * pose.axis, sphere.radius + grown_by);
  }
  return lateral ? overlap(*lateral, *slab) : std::nullopt;
}

double radius_at(const Zone& zone, double z) {
  if (const auto* cylinder = std::get_if<CylinderZone>(&zone.shape)) return cylinder->radius;
  const auto& sphere = std::get<SphereZone>(zone.shape);
  const double h = z - sphere.centre;
  return std::sqrt(std::max(0.0, sphere.radius * sphere.radius - h * h));
}

double zone_support(const Zone& zone, double u) {
  const double across = std::sqrt(std::max(0.0, 1.0 - u * u));
  double z = u > 0.0 ? zone.z_hi : zone.z_lo;
  if (const auto* sphere = std::get_if<SphereZone>(&zone.shape)) {
    z = std::clamp(sphere->centre + sphere->radius * u, zone.z_lo, zone.z_hi);
  }
  return z * u + radius_at(zone, z) * across;
}

}  // namespace

Profile::Profile(std::vector<Zone> zones) : zones_(std::move(zones)) {
  assert(!zones_.empty());
  height_ = zones_.back().z_hi;
  for (const Zone& zone : zones_) {
    for (const double z : {zone.z_lo, zone.z_hi}) {
      max_radius_ = std::max(max_radius_, radius_at(zone, z));
      reach_ = std::max(reach_, std::hypot(z, radius_at(zone, z)));
    }
  }
  // A sphere's belly may lie between its two heights.
  for (const Zone& zone : zones_) {
    if (const auto* sphere = std::get_if<SphereZone>(&zone.shape)) {
      if (sphere->centre >= zone.z_lo && sphere->centre <= zone.z_hi) {
        max_radius_ = std::max(max_radius_, sphere->radius);
      }
      reach_ = std::max(reach_, std::abs(sphere->centre) + sphere->radius);
    }
  }
}

std::optional<Chord> Profile::chord(const ToolPose& pose, const Ray& ray, double grown_by) const {
  const ToolRay tool_ray = in_tool_terms(pose, ray);
  std::optional<Chord> all;
  for (const Zone& zone : zones_) {
    const auto part = zone_chord(zone, pose, tool_ray, grown_by);
    if (!part) continue;
    all = all ? Chord{std::min(all->lo, part->lo), std::max(all->hi, part->hi)} : *part;
  }
  return all;
}

double Profile::support(double u) const {
  double best = -kInfinity;
  for (const Zone& zone : zones_) best = std::max(best, zone_support(zone, u));
  return best;
}

Profile::Nearest Profile::nearest_surface(const ToolPose& pose, const Vec3& point) const {
  const Vec3 m = point - pose.tip;
  const double z = m.dot(pose.axis);
  const Vec3 across = m - z * pose.axis;
  const double rho = across.norm();
  Nearest nearest{std::abs(z - height_), pose.axis};
  const auto offer = [&](double distance, const Vec3& direction) {
    if (distance < nearest.distance) nearest = {distance, direction};
  };
  if (radius_at(zones_.front(), zones_.front().z_lo) > 0.0) offer(std::abs(z), -pose.axis);
  for (const Zone& zone : zones_) {
    const double outside = std::max({0.0, zone.z_lo - z, z - zone.z_hi});
    if (const auto* cylinder = std::get_if<CylinderZone>(&zone.shape)) {
      if (rho > 0.0) offer(std::hypot(outside, rho - cylinder->radius), across / rho);
    } else {
      const auto& sphere = std::get<SphereZone>(zone.shape);
      const Vec3 from_centre = m - sphere.centre * pose.axis;
      const double distance = from_centre.norm();
      if (distance > 0.0) {
        offer(std::hypot(outside, distance - sphere.radius), from_centre / distance);
      }
    }
  }
  return nearest;
}

Vec3 Profile::normal(const ToolPose& pose, const Vec3& point) const {
  return nearest_surface(pose, point).normal;
}

bool Profile::touches(const ToolPose& pose, const Vec3& point, double tolerance) const {
  const Vec3 m = point - pose.tip;
  const double z = m.dot(pose.axis);
  const double rho = (m - z * pose.axis).norm();
  const bool within = std::any_of(zones_.begin(), zones_.end(), [&](const Zone& zone) {
    return z >= zone.z_lo - tolerance && z <= zone.z_hi + tolerance &&
           rho <= radius_at(zone, std::clamp(z, zone.z_lo, zone.z_hi)) + tolerance;
  });
  return within && nearest_surface(pose, point).distance <= tolerance;
}

}  // namespace frustum::cutter
