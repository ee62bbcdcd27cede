#include "stock/polyhedral/mesh_faults.hpp"

// GCC 12 warns of empty function objects inside CGAL's headers, where nothing can be uninitialised.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace frustum::stock {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

std::string place_of(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
}
Vec3 vec_of(const Kernel::Point_3& p) { return {p.x(), p.y(), p.z()}; }

// "1 hole", "3 holes"
std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

// Edges that two facets run along in one direction: facets against each other, or three at an edge.
std::optional<Diagnostic> clashing_edges(const SurfaceMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& [a, b, c] : mesh.triangles) {
    edges.insert(edges.end(), {{a, b}, {b, c}, {c, a}});
  }
  std::sort(edges.begin(), edges.end());
  std::size_t count = 0;
  const std::pair<std::uint32_t, std::uint32_t>* first = nullptr;
  for (std::size_t k = 1; k < edges.size(); ++k) {
    if (edges[k] != edges[k - 1]) continue;
    if (first == nullptr) first = &edges[k];
    ++count;
  }
  if (first == nullptr) return std::nullopt;
  return error(
      "mesh-not-manifold"_id,
      fmt::format("{} with facets that face against each other, or with more than two; the first "
                  "from {} to {} mm",
                  counted(count, "edge", "edges"), place_of(mesh.vertices[first->first]),
                  place_of(mesh.vertices[first->second])),
      "turn the facets so that all of them face out of the material");
}

std::optional<Mesh> joined(const SurfaceMesh& mesh) {
  std::vector<Kernel::Point_3> points;
  points.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) points.emplace_back(v.x(), v.y(), v.z());
  std::vector<std::array<std::size_t, 3>> facets;
  facets.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) facets.push_back({a, b, c});
  if (!pmp::is_polygon_soup_a_polygon_mesh(facets)) return std::nullopt;
  Mesh made;
  pmp::polygon_soup_to_polygon_mesh(points, facets, made);
  return made;
}

std::optional<Diagnostic> holes(const Mesh& mesh) {
  std::vector<Mesh::Halfedge_index> cycles;
  pmp::extract_boundary_cycles(mesh, std::back_inserter(cycles));
  if (cycles.empty()) return std::nullopt;
  std::size_t edges = 0;
  for (const auto h : mesh.halfedges()) edges += mesh.is_border(h) ? 1 : 0;
  return error("mesh-open"_id,
               fmt::format("the mesh is open: {} with {} around; one is at {} mm",
                           counted(cycles.size(), "hole", "holes"), counted(edges, "edge", "edges"),
                           place_of(vec_of(mesh.point(mesh.target(cycles.front()))))),
               "close the holes in the program that made the mesh");
}

std::optional<Diagnostic> crossings(const Mesh& mesh) {
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
  pmp::self_intersections(mesh, std::back_inserter(pairs));
  if (pairs.empty()) return std::nullopt;
  const auto first = std::min_element(pairs.begin(), pairs.end());
  const auto corner = mesh.target(mesh.halfedge(first->first));
  return error(
      "mesh-self-contact"_id,
      fmt::format("{} of facets cross; one of them has a corner at {} mm",
                  counted(pairs.size(), "pair", "pairs"), place_of(vec_of(mesh.point(corner)))),
      "unite the bodies, or repair the mesh, in the program that made it");
}

std::optional<Diagnostic> shells(Mesh& mesh, const SurfaceMesh& given) {
  const auto shell_of = mesh.add_property_map<Mesh::Face_index, std::size_t>("f:shell").first;
  const std::size_t count = pmp::connected_components(mesh, shell_of);
  std::vector<double> volume(count, 0.0);
  std::vector<Vec3> place(count);
  const Vec3 about = given.vertices.front();
  for (const auto f : mesh.faces()) {
    std::array<Vec3, 3> corners;
    std::size_t k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) {
      corners.at(k++) = vec_of(mesh.point(v)) - about;
    }
    volume[shell_of[f]] += corners[0].dot(corners[1].cross(corners[2])) / 6.0;
    place[shell_of[f]] = corners[0] + about;
  }
  const auto outward = static_cast<std::size_t>(
      std::count_if(volume.begin(), volume.end(), [](double v) { return v > 0.0; }));
  if (outward == 0) {
    return error("inside-out-mesh"_id,
                 fmt::format("the mesh is inside out: {} with the facets turned inwards, one at {} "
                             "mm",
                             counted(count, "shell", "shells"), place_of(place.front())),
                 "turn the facets so that all of them face out of the material");
  }
  if (outward > 1) {
    std::string places;
    for (std::size_t s = 0; s < count && places.size() < 200; ++s) {
      if (volume[s] > 0.0) places += (places.empty() ? "" : ", ") + place_of(place[s]);
    }
    return error("mesh-bodies"_id,
                 fmt::format("the mesh is {} bodies apart, with corners at {} mm", outward, places),
                 "a blank is one body: keep one shell");
  }
  if (!pmp::does_bound_a_volume(mesh)) {
    return error(
        "mesh-bodies"_id,
        fmt::format("the {} of the mesh do not bound one body: a void is outside it, or is "
                    "not turned inwards",
                    counted(count, "shell", "shells")),
        "facets face out of the material, so those of a void face into it");
  }
  return std::nullopt;
}

}  // namespace

Diagnostics mesh_faults(const SurfaceMesh& mesh) {
  if (mesh.triangles.empty()) return {error("mesh-empty"_id, "the mesh has no triangles")};
  if (const auto clash = clashing_edges(mesh)) return {*clash};
  auto made = joined(mesh);
  if (!made) {
    return {error("mesh-not-manifold"_id,
                  "the mesh is not manifold: its facets cannot be joined to a surface",
                  "remove doubled and loose facets")};
  }
  Diagnostics found;
  if (const auto open = holes(*made)) found.push_back(*open);
  if (const auto cross = crossings(*made)) found.push_back(*cross);
  if (found.empty()) {
    if (const auto fault = shells(*made, mesh)) found.push_back(*fault);
  }
  return found;
}

}  // namespace frustum::stock
