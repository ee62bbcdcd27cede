#include "stock/mesh/surface_mesh.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "stock/mesh/surface_mesh_cells.hpp"
#include "stock/mesh/surface_mesh_crossings.hpp"
#include "stock/mesh/surface_mesh_placing.hpp"
#include "stock/mesh/unfold_surface.hpp"

namespace frustum::stock {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Quad = std::array<std::uint32_t, 4>;

// The vertices of the four cells around an edge, counter-clockwise seen from outside.
Quad quad_around(const Cells& cells, int axis, std::array<int, 3> node, bool lower_inside) {
  constexpr std::array<std::array<int, 2>, 4> kRound{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  Quad quad{};
  for (std::size_t k = 0; k < 4; ++k) {
    const auto [a, b] = kRound[k];
    std::array<int, 3> place = node;
    place[static_cast<std::size_t>((axis + 1) % 3)] -= a;
    place[static_cast<std::size_t>((axis + 2) % 3)] -= b;
    const Cell& cell = cells.at(place[0], place[1], place[2]);
    quad[k] = cell.first_vertex + cell.piece(4 * axis + a + 2 * b);
  }
  // Around +axis this is counter-clockwise; outside is +axis if the material is below.
  if (!lower_inside) std::swap(quad[1], quad[3]);
  return quad;
}

// One of the two ways to split a quad.
struct Split {
  std::array<Triangle, 2> triangles;
  double miss = 0.0;      // from the exact crossing of the grid edge, along the edge; mm
  bool folded = false;    // a triangle faces inwards, seen along the edge, or has no area
  double diagonal = 0.0;  // its length, mm
};

// Seen along the edge (plane of d + 1, d + 2), relative to the crossing.
struct Seen {
  double u = 0.0;
  double v = 0.0;
};
double twice_area(const Seen& a, const Seen& b, const Seen& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

// Three vertices on one straight edge of the solid.
bool is_needle(const SurfaceMesh& mesh, const Triangle& triangle) {
  const Vec3 ab = mesh.vertices[triangle[1]] - mesh.vertices[triangle[0]];
  const Vec3 ac = mesh.vertices[triangle[2]] - mesh.vertices[triangle[0]];
  const Vec3 bc = ac - ab;
  // A height of a millionth of the longest side, as measure() counts them.
  const double longest = std::max({ab.squaredNorm(), ac.squaredNorm(), bc.squaredNorm()});
  return ab.cross(ac).norm() <= 1e-6 * longest;
}

Split split_along(const SurfaceMesh& mesh, const Quad& quad, std::size_t from, int axis,
                  const Vec3& crossing, bool lower_inside) {
  Split split;
  split.triangles = {Triangle{quad[from], quad[from + 1], quad[from + 2]},
                     Triangle{quad[from], quad[from + 2], quad[(from + 3) % 4]}};
  split.diagonal = (mesh.vertices[quad[from]] - mesh.vertices[quad[from + 2]]).norm();
  split.miss = std::numeric_limits<double>::infinity();
  const double sense = lower_inside ? 1.0 : -1.0;
  for (const Triangle& triangle : split.triangles) {
    std::array<Seen, 3> seen;
    std::array<double, 3> along{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 at = mesh.vertices[triangle[k]] - crossing;
      seen[k] = {at[(axis + 1) % 3], at[(axis + 2) % 3]};
      along[k] = at[axis];
    }
    split.folded = split.folded || is_needle(mesh, triangle);
    const double area = sense * twice_area(seen[0], seen[1], seen[2]);
    if (area <= 0.0) {
      split.folded = true;
      continue;
    }
    const Seen edge;  // the grid edge is seen as the origin
    const double w0 = sense * twice_area(edge, seen[1], seen[2]) / area;
    const double w1 = sense * twice_area(edge, seen[2], seen[0]) / area;
    const double w2 = 1.0 - w0 - w1;
    // On the diagonal the edge belongs to both triangles; 1e-9 forgives the rounding of the
    // weights.
    if (std::min({w0, w1, w2}) < -1e-9) continue;
    split.miss = std::min(split.miss, std::abs(w0 * along[0] + w1 * along[1] + w2 * along[2]));
  }
  return split;
}

// The split that meets the exact surface on the grid edge; this also finds the sharp edges. If both
// do about as well: the one without folds, then the shorter diagonal.
std::array<Triangle, 2> split(const SurfaceMesh& mesh, const Quad& quad, int axis,
                              const Vec3& crossing, bool lower_inside, double pitch) {
  const Split first = split_along(mesh, quad, 0, axis, crossing, lower_inside);
  const Split second = split_along(mesh, quad, 1, axis, crossing, lower_inside);
  // Below this the two differ by the curvature of the surface or by rounding, not by a sharp edge.
  const double same = 1e-2 * pitch;
  const bool both_miss = std::isinf(first.miss) && std::isinf(second.miss);
  if (!both_miss && !(std::abs(first.miss - second.miss) <= same)) {
    return first.miss < second.miss ? first.triangles : second.triangles;
  }
  if (first.folded != second.folded) return first.folded ? second.triangles : first.triangles;
  // Squares in the grid have equal diagonals but for rounding: then always the first.
  return second.diagonal < first.diagonal * (1.0 - 1e-9) ? second.triangles : first.triangles;
}

void connect(const Crossings& crossings, const Cells& cells, SurfaceMesh& mesh) {
  const DexelGrid& grid = crossings.grid();
  mesh.triangles.resize(2 * (crossings.count(0) + crossings.count(1) + crossings.count(2)));
  std::size_t first_of_axis = 0;
  for (int axis = 0; axis < 3; ++axis) {
    tbb::parallel_for(0, grid.nodes[1], [&](int j) {
      for (int i = 0; i < grid.nodes[0]; ++i) {
        std::size_t edge = crossings.first(axis, i, j);
        for (const auto& [level, lower_inside] : crossings.edges(axis, i, j)) {
          const Quad quad = quad_around(cells, axis, {i, j, level}, lower_inside);
          const auto triangles =
              split(mesh, quad, axis, crossings.sample(edge, axis).point, lower_inside, grid.pitch);
          const std::size_t at = 2 * (first_of_axis + edge);
          mesh.triangles[at] = triangles[0];
          mesh.triangles[at + 1] = triangles[1];
          ++edge;
        }
      }
    });
    first_of_axis += crossings.count(axis);
  }
}

}  // namespace

SurfaceMesh surface_of(SolidView solid, const Crossings& crossings, const Cells& cells,
                       PlacedVertices placed) {
  keep_apart(solid, crossings, cells, placed);
  SurfaceMesh mesh{.vertices = std::move(placed.points),
                   .normals = std::move(placed.normals),
                   .kinds = std::move(placed.kinds)};
  connect(crossings, cells, mesh);
  unfold_surface(mesh);
  return mesh;
}

SurfaceMesh extract_surface(SolidView solid, const TriDexel& dexels) {
  const Crossings crossings(solid, dexels);
  const Cells cells(crossings);
  return surface_of(solid, crossings, cells, place_vertices(solid, crossings, cells));
}

Result<SurfaceMesh> extract_surface(SolidView solid, const BoundingBox& box, Mm pitch) {
  auto dexels = TriDexel::sample(solid, box, pitch);
  if (!dexels) return std::move(dexels).error();
  return extract_surface(solid, *dexels);
}

}  // namespace frustum::stock
