#include "stock/mesh/vertex_fan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace frustum::stock {
namespace {

double cross2(const Vec3& a, const Vec3& b) { return a.x() * b.y() - a.y() * b.x(); }

}  // namespace

bool VertexFan::look(std::span<const Vec3> vertices, const TriangleLinks& links,
                     std::uint32_t centre) {
  vertex = centre;
  size = 0;
  bool fits = true;
  links.for_each_leaving(vertex, [&](std::uint32_t leaving) {
    if (size == kMostSpokes) {
      fits = false;
      return;
    }
    half[size] = leaving;
    spoke[size++] = links.to(leaving);
  });
  if (!fits) return false;
  const Vec3& middle = vertices[vertex];
  std::array<Vec3, kMostSpokes> arm;
  for (std::size_t i = 0; i < size; ++i) arm[i] = vertices[spoke[i]] - middle;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < size; ++i) {
    normal[i] = arm[i].cross(arm[after(i)]);
    sum += normal[i];
  }
  const double length = sum.norm();
  is_graph = length > 0.0;
  if (!is_graph) return true;
  up = sum / length;
  x = perpendicular_to(up);
  y = up.cross(x);
  for (std::size_t i = 0; i < size; ++i) {
    seen[i] = {arm[i].dot(x), arm[i].dot(y), arm[i].dot(up)};
  }
  for (std::size_t i = 0; i < size; ++i) {
    is_graph = is_graph && cross2(seen[i], seen[after(i)]) > 0.0;
  }
  return true;
}

// Differences are greatest at the old vertex or where a new spoke crosses an old one.
double VertexFan::departure(std::size_t target) const {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  if (!is_graph) return kInfinite;
  const Vec3& to = seen[target];
  double most = 0.0;
  bool covered = false;
  for (std::size_t i = after(target); after(i) != target; i = after(i)) {
    const Vec3 a = seen[i] - to;
    const Vec3 b = seen[after(i)] - to;
    const double area = cross2(a, b);
    if (!(area > 0.0)) return kInfinite;
    const double u = cross2(-to, b) / area;
    const double v = cross2(a, -to) / area;
    // 1e-9: the old vertex on a new spoke is in both triangles.
    if (u >= -1e-9 && v >= -1e-9 && u + v <= 1.0 + 1e-9) {
      covered = true;
      most = std::max(most, std::abs(to.z() + u * a.z() + v * b.z()));
    }
    if (after(after(i)) == target) break;
    // The new spoke to the corner after i.
    for (std::size_t j = 0; j < size; ++j) {
      if (j == target || j == after(i)) continue;
      const Vec3& old = seen[j];
      const double across = cross2(b, old);
      if (across == 0.0) continue;
      const double s = -cross2(to, old) / across;
      if (!(s >= 0.0 && s <= 1.0)) continue;
      const Vec3 crossing = to + s * b;
      const double t = (crossing.x() * old.x() + crossing.y() * old.y()) /
                       (old.x() * old.x() + old.y() * old.y());
      if (t >= 0.0 && t <= 1.0) most = std::max(most, std::abs(crossing.z() - t * old.z()));
    }
  }
  return covered ? most : kInfinite;
}

// Spokes of the new fan divide the polygon: mostly it is where the old triangle was.
std::uint32_t VertexFan::sector(std::size_t target, const Vec3& at, std::size_t from) const {
  const Vec3 arm = at - seen[target];
  const auto is_before = [&](std::size_t i) { return cross2(seen[i] - seen[target], arm) <= 0.0; };
  const std::size_t first = after(target), last = before(before(target));
  std::size_t i = from == target ? first : from == before(target) ? last : from;
  while (i != last && !is_before(after(i))) i = after(i);
  while (i != first && is_before(i)) i = before(i);
  return static_cast<std::uint32_t>(i >= first ? i - first : i + size - first);
}

}  // namespace frustum::stock
