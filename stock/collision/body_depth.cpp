#include "stock/collision/body_depth.hpp"

namespace frustum::stock {
namespace {

// Of what `along` finds along each axis.
template <class Along>
Overlap shortest(const Along& along) {
  Overlap shortest = along(0);
  for (int axis = 1; axis < 3; ++axis) {
    const Overlap other = along(axis);
    if (other.length < shortest.length) shortest = other;
  }
  return shortest;
}

}  // namespace

Overlap DepthSearch::depth_near(const BodyInBlock& body, const Vec3& place) const {
  return shortest([&](int axis) { return longest_along(axis, body, place); });
}

Overlap DepthSearch::depth_at(const BodyInBlock& body, const Vec3& place) const {
  return shortest([&](int axis) { return along(axis, body, place); });
}

Overlap DepthSearch::longest_along(int axis, const BodyInBlock& body, const Vec3& place) const {
  const Vec3 u = Vec3::Unit((axis + 1) % 3), v = Vec3::Unit((axis + 2) % 3);
  Overlap best = along(axis, body, place);
  for (double step = first_step_; step > 0.5 * last_step_; step *= 0.5) {
    const Vec3 centre = best.point;
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        if (i == 0 && j == 0) continue;
        const Overlap other = along(axis, body, centre + i * step * u + j * step * v);
        if (other.length > best.length) best = other;
      }
    }
  }
  return best;
}

// Of the ray through the place.
Overlap DepthSearch::along(int axis, const BodyInBlock& key, const Vec3& place) const {
  const BoundingBox box = workpiece_.blank().bounds();
  Ray ray{place, Vec3::Unit(axis)};
  ray.origin[axis] = box.min[axis];
  const RaySpan span{0.0, box.max[axis] - box.min[axis]};
  const kinematics::ToolPath& path = workpiece_.removed().path();
  const std::uint32_t first = table_.first_segment(key.block);
  const std::uint32_t last = table_.first_segment(key.block + 1);
  const IntervalSet left = workpiece_.material_along(ray, span, last);
  Overlap longest{0.0, place};
  for (const NonCuttingBody& body : bodies_) {
    if (body.body != key.body || body.tool != path.blocks[key.block].tool) continue;
    for (std::uint32_t s = first; s < last; ++s) {
      const IntervalSet met = left.intersected(core_along(ray, body, path, path.segments[s]));
      for (const Interval& piece : met.intervals()) {
        if (piece.length() <= longest.length) continue;
        longest = {piece.length(), ray.at(0.5 * (piece.lo + piece.hi))};
      }
    }
  }
  return longest;
}

}  // namespace frustum::stock
