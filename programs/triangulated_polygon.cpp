#include "programs/triangulated_polygon.hpp"

#include <algorithm>
#include <cstddef>

namespace frustum::programs {
namespace {

// Twice the area of a triangle.
double turn(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool is_inside(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  // A bridge passes its corners twice.
  const auto is = [&p](const Vec3& corner) { return p.head<2>() == corner.head<2>(); };
  if (is(a) || is(b) || is(c)) return false;
  return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
}

// `ring`: numbers of corners in order, some of them twice where a bridge leads there and back.
std::vector<Triangle> clipped(std::span<const Vec3> corners, std::vector<std::uint32_t> ring) {
  std::vector<Triangle> triangles;
  const auto is_ear = [&](std::size_t i) {
    const std::size_t n = ring.size();
    const Vec3 &a = corners[ring[(i + n - 1) % n]], &b = corners[ring[i]],
               &c = corners[ring[(i + 1) % n]];
    if (!(turn(a, b, c) > 0.0)) return false;
    return std::ranges::none_of(ring,
                                [&](std::uint32_t k) { return is_inside(corners[k], a, b, c); });
  };
  std::size_t at = 0, refused = 0;
  while (ring.size() >= 3 && refused < ring.size()) {
    const std::size_t n = ring.size();
    at %= n;
    if (!is_ear(at)) {
      ++at;
      ++refused;
      continue;
    }
    triangles.push_back({ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
    // From there on, so that triangles do not all share one corner.
    ++at;
    refused = 0;
  }
  return triangles;
}

}  // namespace

double area_of(std::span<const Vec3> outline) {
  double twice = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    twice += turn(Vec3::Zero(), outline[i], outline[(i + 1) % outline.size()]);
  }
  return 0.5 * twice;
}

std::vector<Triangle> triangles_of(std::span<const Vec3> outline) {
  std::vector<std::uint32_t> ring;
  for (std::size_t i = 0; i < outline.size(); ++i) ring.push_back(static_cast<std::uint32_t>(i));
  return clipped(outline, std::move(ring));
}

std::vector<Triangle> triangles_around(std::span<const Vec3> outline, std::span<const Vec3> hole) {
  std::vector<Vec3> corners(outline.begin(), outline.end());
  corners.insert(corners.end(), hole.begin(), hole.end());
  // Nothing of the hole is to the right of its rightmost corner, so that the way from there to the
  // rightmost corner of the outline is free.
  const auto rightmost = [](std::span<const Vec3> of) {
    const auto found = std::ranges::max_element(of, {}, [](const Vec3& p) { return p.x(); });
    return static_cast<std::size_t>(found - of.begin());
  };
  const std::size_t from = rightmost(outline), to = rightmost(hole);
  std::vector<std::uint32_t> ring;
  for (std::size_t i = 0; i <= outline.size(); ++i) {
    ring.push_back(static_cast<std::uint32_t>((from + i) % outline.size()));
  }
  for (std::size_t i = 0; i <= hole.size(); ++i) {
    ring.push_back(
        static_cast<std::uint32_t>(outline.size() + (to + hole.size() - i) % hole.size()));
  }
  return clipped(corners, std::move(ring));
}

}  // namespace frustum::programs
