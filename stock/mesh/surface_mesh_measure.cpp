#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "stock/mesh/open_mesh.hpp"
#include "stock/mesh/surface_mesh.hpp"
#include "stock/mesh/triangle_links.hpp"

namespace frustum::stock {
namespace {

// Whether so many triangles meet at a vertex that linking them takes long.
bool has_wide_fans(const SurfaceMesh& mesh) {
  constexpr std::uint32_t kWide = 256;
  std::vector<std::uint32_t> at(mesh.vertices.size(), 0);
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      if (++at[vertex] > kWide) return true;
    }
  }
  return false;
}

// True if no two triangles run along an edge in the same direction. OpenMesh would refuse such a
// triangle too, but not without a line on stderr.
bool directed_edges_differ(const SurfaceMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
  }
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

// Pieces connected through their edges.
std::size_t count_components(const OpenMesh3& mesh) {
  std::vector<bool> seen(mesh.n_faces(), false);
  std::vector<OpenMesh3::FaceHandle> open;
  std::size_t components = 0;
  for (const auto start : mesh.faces()) {
    if (seen[static_cast<std::size_t>(start.idx())]) continue;
    ++components;
    seen[static_cast<std::size_t>(start.idx())] = true;
    open.push_back(start);
    while (!open.empty()) {
      const auto face = open.back();
      open.pop_back();
      for (const auto next : mesh.ff_range(face)) {
        if (seen[static_cast<std::size_t>(next.idx())]) continue;
        seen[static_cast<std::size_t>(next.idx())] = true;
        open.push_back(next);
      }
    }
  }
  return components;
}

// The same of a closed mesh.
std::size_t count_components(const TriangleLinks& links) {
  std::vector<bool> seen(links.triangles.size(), false);
  std::vector<std::uint32_t> open;
  std::size_t components = 0;
  const auto reach = [&](std::uint32_t triangle) {
    if (seen[triangle]) return;
    seen[triangle] = true;
    open.push_back(triangle);
  };
  for (std::uint32_t start = 0; start < links.triangles.size(); ++start) {
    if (seen[start]) continue;
    ++components;
    reach(start);
    while (!open.empty()) {
      const std::uint32_t first = 3 * open.back();
      open.pop_back();
      for (std::uint32_t half = first; half < first + 3; ++half) reach(links.across[half] / 3);
    }
  }
  return components;
}

// A point of the mesh: about it a part far from the origin loses no digits.
Vec3 point_of(const SurfaceMesh& mesh) {
  return mesh.vertices.empty() ? Vec3(Vec3::Zero()) : mesh.vertices.front();
}

}  // namespace

double enclosed_volume(const SurfaceMesh& mesh) {
  const Vec3 about = point_of(mesh);
  double volume = 0.0;
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Vec3 b = mesh.vertices[ib] - about, c = mesh.vertices[ic] - about;
    volume += (mesh.vertices[ia] - about).dot(b.cross(c)) / 6.0;
  }
  return volume;
}

MeshMeasure measure(const SurfaceMesh& mesh) {
  MeshMeasure found{.volume = enclosed_volume(mesh)};
  const Vec3 about = point_of(mesh);
  for (const auto& [ia, ib, ic] : mesh.triangles) {
    const Vec3 a = mesh.vertices[ia] - about;
    const Vec3 b = mesh.vertices[ib] - about;
    const Vec3 c = mesh.vertices[ic] - about;
    const double twice_area = (b - a).cross(c - a).norm();
    const double longest =
        std::sqrt(std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()}));
    found.area += twice_area / 2.0;
    // Height over the longest side, relative to it. A millionth: what single precision files keep.
    if (!(twice_area > 1e-6 * longest * longest)) ++found.degenerate_triangles;
  }
  const auto links =
      has_wide_fans(mesh) ? std::nullopt : linked(mesh.triangles, mesh.vertices.size());
  if (links) {
    found.is_closed = found.is_manifold = true;
    found.components = count_components(*links);
    return found;
  }
  const bool edges_differ = directed_edges_differ(mesh);
  const OpenMesh3 built = open_mesh_of(mesh);
  found.is_closed = std::all_of(built.edges().begin(), built.edges().end(),
                                [&](const auto& edge) { return !built.is_boundary(edge); });
  found.is_manifold = edges_differ && built.n_faces() == mesh.triangles.size() &&
                      std::all_of(built.vertices().begin(), built.vertices().end(),
                                  [&](const auto& vertex) { return built.is_manifold(vertex); });
  found.components = count_components(built);
  return found;
}

}  // namespace frustum::stock
