#include "stock/collision/convex_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace frustum::stock {
namespace {

using cutter::Zone;
using cutter::ZoneKind;

struct MeridianCorner {
  double r = 0.0, z = 0.0;
};

double radius_of(const Zone& zone, double z) {
  if (zone.kind == ZoneKind::cone) return zone.radius + zone.slope * (z - zone.z_lo);
  const double up = z - zone.centre;
  const double r = std::sqrt(std::max(0.0, zone.radius * zone.radius - up * up));
  return std::max(0.0, zone.kind == ZoneKind::sphere ? r : zone.major + r);
}

// The point of an arc that faces the direction, or the end of the arc nearest to it.
MeridianCorner facing_point(const Zone& zone, double across, double up) {
  const double length = std::hypot(across, up);
  const double z = length > 0.0 ? zone.centre + zone.radius * up / length : zone.centre;
  const double within = std::clamp(z, zone.z_lo, zone.z_hi);
  return {radius_of(zone, within), within};
}

Vec3 support_of(const Box& box, const Vec3& d) {
  return {d.x() < 0.0 ? box.min.x() : box.max.x(), d.y() < 0.0 ? box.min.y() : box.max.y(),
          d.z() < 0.0 ? box.min.z() : box.max.z()};
}

Vec3 support_of(const std::vector<Zone>& zones, const Vec3& d) {
  const double across = std::hypot(d.x(), d.y());
  MeridianCorner best;
  double farthest = -std::numeric_limits<double>::infinity();
  const auto offer = [&](const MeridianCorner& corner) {
    const double far = corner.r * across + corner.z * d.z();
    if (far <= farthest) return;
    farthest = far;
    best = corner;
  };
  for (const Zone& zone : zones) {
    if (zone.kind == ZoneKind::cone) {
      offer({radius_of(zone, zone.z_lo), zone.z_lo});
      offer({radius_of(zone, zone.z_hi), zone.z_hi});
    } else {
      offer(facing_point(zone, across, d.z()));
    }
  }
  if (across == 0.0) return {best.r, 0.0, best.z};
  return {best.r * d.x() / across, best.r * d.y() / across, best.z};
}

Vec3 support_of(const std::vector<Vec3>& corners, const Vec3& d) {
  const Vec3* best = &corners.front();
  double farthest = best->dot(d);
  for (const Vec3& corner : corners) {
    const double far = corner.dot(d);
    if (far <= farthest) continue;
    farthest = far;
    best = &corner;
  }
  return *best;
}

}  // namespace

ConvexShape ConvexShape::box(const Box& box) { return ConvexShape(box); }
ConvexShape ConvexShape::revolved(std::span<const Zone> zones) {
  return ConvexShape(Zones(zones.begin(), zones.end()));
}
ConvexShape ConvexShape::hull(std::vector<Vec3> corners) { return ConvexShape(std::move(corners)); }

Vec3 ConvexShape::support(const Vec3& d) const {
  return std::visit([&d](const auto& form) { return support_of(form, d); }, form_);
}

Box ConvexShape::bounds() const {
  Box bounds;
  for (int axis = 0; axis < 3; ++axis) {
    bounds.max[axis] = support(Vec3::Unit(axis))[axis];
    bounds.min[axis] = support(-Vec3::Unit(axis))[axis];
  }
  return bounds;
}

}  // namespace frustum::stock
