#include "bench/peers/faceted_cutter.hpp"

#include <cmath>
#include <numbers>

namespace frustum::bench {
namespace {

using std::numbers::pi;

struct FacetRing {
  double radius = 0.0;
  double z = 0.0;
};

std::vector<FacetRing> facet_rings(const PeerScene& scene, int facets, double growth) {
  const double wide = scene.radius * growth;
  if (!scene.is_ball) return {{wide, 0.0}, {wide, scene.height}};
  std::vector<FacetRing> rings;
  const int quarter = facets / 4;
  const double grown = wide * growth;  // for the facets along the meridian once more
  for (int k = 0; k <= quarter; ++k) {
    const double slope = 0.5 * pi * k / quarter;
    rings.push_back({grown * std::sin(slope), scene.radius - grown * std::cos(slope)});
  }
  rings.push_back({grown, scene.height});
  return rings;
}

void add_cutter(std::vector<Vec3>& points, const std::vector<FacetRing>& rings,
                const kinematics::ToolPose& pose, int facets, Facing facing) {
  const Vec3 aside = facing == Facing::fixed ? Vec3(Vec3::UnitX()) : Vec3(-pose.tip);
  const Vec3 e1 = (aside - aside.dot(pose.axis) * pose.axis).normalized();
  const Vec3 e2 = pose.axis.cross(e1);
  for (const FacetRing& ring : rings) {
    if (ring.radius == 0.0) {
      points.push_back(pose.tip + ring.z * pose.axis);
      continue;
    }
    for (int j = 0; j < facets; ++j) {
      const double angle = 2.0 * pi * j / facets;
      points.push_back(pose.tip + ring.z * pose.axis +
                       ring.radius * (std::cos(angle) * e1 + std::sin(angle) * e2));
    }
  }
}

}  // namespace

std::vector<std::vector<Vec3>> hulls_of_blocks(const PeerScene& scene, int facets, Facing facing) {
  const double growth = facing == Facing::contact ? 1.0 : 2.0 / (1.0 + std::cos(pi / facets));
  const std::vector<FacetRing> rings = facet_rings(scene, facets, growth);
  std::vector<std::vector<Vec3>> hulls;
  hulls.reserve(scene.path.segments.size());
  for (const kinematics::PathSegment& segment : scene.path.segments) {
    std::vector<Vec3>& points = hulls.emplace_back();
    add_cutter(points, rings, scene.path.from(segment), facets, facing);
    add_cutter(points, rings, scene.path.to(segment), facets, facing);
  }
  return hulls;
}

}  // namespace frustum::bench
