#include "programs/s_piece/s_blank.hpp"

#include <algorithm>
#include <cmath>

#include "core/box.hpp"
#include "programs/triangulated_polygon.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::programs {
namespace {

using Facet = stock::FacetSolid::Facet;

constexpr double kAllowance = 0.3;   // mm on both flanks
constexpr double kBelow = 8.0;       // mm from curve C0 down to the box
constexpr double kFree = 1.5;        // mm between box and cutter
constexpr double kBoxHeight = 22.0;  // mm
constexpr double kMargin = 20.0;     // mm of the box around the wall
constexpr std::size_t kAlong = 100;  // facets' widths along a flank
constexpr std::size_t kUp = 4;       // and up a ruling

// On the parallel surface of a flank, at a height.
Vec3 beside(const SplineSurface& flank, double u, double z) {
  const double low = flank.point(u, 0.0).z(), high = flank.point(u, 1.0).z();
  double v = (z - low) / (high - low);
  Vec3 p = Vec3::Zero();
  constexpr int kRounds = 5;
  for (int i = 0; i < kRounds; ++i) {
    const SplinePoint on = flank.at(u, v);
    p = on.r + kAllowance * on.normal();
    v += (z - p.z()) / on.v.z();
  }
  p.z() = z;
  return p;
}

// Around the wall, counter-clockwise seen from above.
std::vector<Vec3> outline_at(const SGeometry& shape, double z, bool reverse) {
  std::vector<Vec3> outline;
  for (const SplineSurface& flank : shape.flanks) {
    for (std::size_t i = 0; i <= kAlong; ++i) {
      outline.push_back(beside(flank, static_cast<double>(i) / kAlong, z));
    }
  }
  if (reverse) std::ranges::reverse(outline);
  return outline;
}

class Mesh {
 public:
  std::uint32_t add(const std::vector<Vec3>& row) {
    const auto first = static_cast<std::uint32_t>(vertices_.size());
    vertices_.insert(vertices_.end(), row.begin(), row.end());
    return first;
  }
  // Rows of as many corners counter-clockwise seen from above: a wall between them.
  void wall(std::uint32_t upper, std::uint32_t lower, std::size_t corners) {
    const auto count = static_cast<std::uint32_t>(corners);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t j = (i + 1) % count;
      facets_.push_back({upper + i, lower + i, lower + j});
      facets_.push_back({upper + i, lower + j, upper + j});
    }
  }
  // Triangles whose corners count from `first`, or from `second` where they are beyond `split`.
  void face(const std::vector<Triangle>& triangles, std::uint32_t first, std::uint32_t second,
            std::size_t split, bool up) {
    const auto corner = [&](std::uint32_t k) {
      return k < split ? first + k : second + (k - static_cast<std::uint32_t>(split));
    };
    for (const Triangle& t : triangles) {
      const Facet f{corner(t[0]), corner(t[1]), corner(t[2])};
      facets_.push_back(up ? f : Facet{f[0], f[2], f[1]});
    }
  }
  [[nodiscard]] stock::FacetSolid solid() && { return {std::move(vertices_), std::move(facets_)}; }

 private:
  std::vector<Vec3> vertices_{};
  std::vector<Facet> facets_{};
};

std::vector<Vec3> around(const std::vector<Vec3>& outline, double z) {
  Box box{outline.front(), outline.front()};
  for (const Vec3& p : outline) box = {box.min.cwiseMin(p), box.max.cwiseMax(p)};
  const double x0 = std::floor(box.min.x() - kMargin), x1 = std::ceil(box.max.x() + kMargin);
  const double y0 = std::floor(box.min.y() - kMargin), y1 = std::ceil(box.max.y() + kMargin);
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

}  // namespace

Result<stock::MeshShape> s_blank(const SGeometry& shape, double reach) {
  const double base = shape.base - std::max(kBelow, std::ceil(reach + kFree));
  const bool reverse = area_of(outline_at(shape, shape.base, false)) < 0.0;
  Mesh mesh;
  std::vector<Vec3> outline = outline_at(shape, shape.top, reverse);
  const std::size_t corners = outline.size();
  const auto top = triangles_of(outline);
  std::uint32_t upper = mesh.add(outline);
  mesh.face(top, upper, upper, corners, true);
  for (std::size_t k = 1; k <= kUp; ++k) {
    const double share = static_cast<double>(k) / kUp;
    outline = outline_at(shape, shape.top + (base - shape.top) * share, reverse);
    const std::uint32_t lower = mesh.add(outline);
    mesh.wall(upper, lower, corners);
    upper = lower;
  }
  std::vector<Vec3> box = around(outline, base);
  const auto ledge = triangles_around(box, outline);
  const std::uint32_t rim = mesh.add(box);
  mesh.face(ledge, rim, upper, box.size(), true);
  for (Vec3& p : box) p.z() = base - kBoxHeight;
  const std::uint32_t foot = mesh.add(box);
  mesh.wall(rim, foot, box.size());
  mesh.face(triangles_of(box), foot, foot, box.size(), false);
  if (top.size() != corners - 2 || ledge.size() != corners + box.size()) {
    Diagnostic failure = error("flanks-cross"_id, "the flanks cross each other, or themselves",
                               "check the order of the control points, and that B is the other "
                               "side of the wall");
    failure.key = "points";
    return failure;
  }
  return stock::MeshShape{std::make_shared<const stock::FacetSolid>(std::move(mesh).solid()),
                          "blank.ply"};
}

}  // namespace frustum::programs
