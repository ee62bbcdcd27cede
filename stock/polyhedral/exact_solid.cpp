#include "stock/polyhedral/exact_solid.hpp"

// GCC 12 warns of empty function objects inside CGAL's headers, where nothing can be uninitialised.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <exception>
#include <utility>
#include <vector>

namespace frustum::stock {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<Kernel::Point_3>;

enum class Boolean { united, minus };

using Vertex = ExactMesh::Vertex_index;
using Half = ExactMesh::Halfedge_index;

// The faces on both sides are in one plane.
bool is_flat(const ExactMesh& mesh, Half half) {
  const auto& across = mesh.point(mesh.target(mesh.next(half)));
  const auto& beyond = mesh.point(mesh.target(mesh.next(mesh.opposite(half))));
  return CGAL::coplanar(mesh.point(mesh.source(half)), mesh.point(mesh.target(half)), across,
                        beyond);
}

// Moving the target of `half` to its source, within the planes of its faces, turns none over.
bool may_collapse(const ExactMesh& mesh, Half half) {
  const Vertex goes = mesh.target(half);
  const Vertex stays = mesh.source(half);
  for (const Half into : mesh.halfedges_around_target(half)) {
    const Vertex a = mesh.source(into);
    const Vertex b = mesh.target(mesh.next(into));
    if (a == stays || b == stays) continue;
    if (CGAL::coplanar_orientation(mesh.point(a), mesh.point(b), mesh.point(goes),
                                   mesh.point(stays)) != CGAL::POSITIVE) {
      return false;
    }
  }
  return CGAL::Euler::does_satisfy_link_condition(mesh.edge(half), mesh);
}

// The edge along which a vertex goes that is no corner of the solid: within a face, or on the line
// of an edge between two faces.
std::optional<Half> needless(const ExactMesh& mesh, Vertex vertex) {
  std::vector<Half> bent;
  for (const Half into : mesh.halfedges_around_target(mesh.halfedge(vertex))) {
    if (is_flat(mesh, into)) continue;
    bent.push_back(into);
    if (bent.size() > 2) return std::nullopt;
  }
  if (bent.empty()) {
    for (const Half into : mesh.halfedges_around_target(mesh.halfedge(vertex))) {
      if (may_collapse(mesh, into)) return into;
    }
    return std::nullopt;
  }
  if (bent.size() != 2 || !CGAL::collinear(mesh.point(mesh.source(bent[0])), mesh.point(vertex),
                                           mesh.point(mesh.source(bent[1])))) {
    return std::nullopt;
  }
  for (const Half into : bent) {
    if (may_collapse(mesh, into)) return into;
  }
  return std::nullopt;
}

// Takes away the vertices that only the triangles of flat faces have made. A corner of the solid is
// where three of the given planes meet, with as many digits after a hundred cuts as after one; but
// where a diagonal of one cut crosses the next, digits multiply with every cut.
void keep_corners(ExactMesh& mesh) {
  std::vector<Vertex> open(mesh.vertices().begin(), mesh.vertices().end());
  while (!open.empty()) {
    const Vertex vertex = open.back();
    open.pop_back();
    if (mesh.is_removed(vertex)) continue;
    const std::optional<Half> along = needless(mesh, vertex);
    if (!along) continue;
    const Vertex stays = mesh.source(*along);
    for (const Vertex next : mesh.vertices_around_target(*along)) {
      if (next != stays) open.push_back(next);
    }
    const Kernel::Point_3 point = mesh.point(stays);
    const Vertex joined = CGAL::Euler::collapse_edge(mesh.edge(*along), mesh);
    mesh.point(joined) = point;
    open.push_back(joined);
  }
}

// Copies, since the operation refines its operands. Their self-intersections are not looked for:
// hulls have none, and exact results of exact operands neither.
std::optional<ExactMesh> combined(Boolean operation, ExactMesh left, ExactMesh right) {
  ExactMesh result;
  try {
    const bool manifold = operation == Boolean::united
                              ? pmp::corefine_and_compute_union(left, right, result)
                              : pmp::corefine_and_compute_difference(left, right, result);
    if (!manifold) return std::nullopt;
    keep_corners(result);
    result.collect_garbage();
    // What the lazy kernel has put off is evaluated, so that its expressions do not grow with
    // every cut.
    for (const auto v : result.vertices()) result.point(v).exact();
  } catch (const std::exception&) {  // a precondition of CGAL
    return std::nullopt;
  }
  return result;
}

}  // namespace

struct ExactSolid::Mesh {
  ExactMesh exact{};
};

ExactSolid::ExactSolid(std::unique_ptr<Mesh> mesh) : mesh_(std::move(mesh)) {}
ExactSolid::~ExactSolid() = default;
ExactSolid::ExactSolid(ExactSolid&&) noexcept = default;
ExactSolid& ExactSolid::operator=(ExactSolid&&) noexcept = default;

ExactSolid::ExactSolid(const SurfaceMesh& mesh) : mesh_(std::make_unique<Mesh>()) {
  std::vector<ExactMesh::Vertex_index> copies;
  copies.reserve(mesh.vertices.size());
  for (const Vec3& p : mesh.vertices) {
    copies.push_back(mesh_->exact.add_vertex({p.x(), p.y(), p.z()}));
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    mesh_->exact.add_face(copies[a], copies[b], copies[c]);
  }
}

std::optional<ExactSolid> ExactSolid::united(const ExactSolid& other) const {
  auto made = combined(Boolean::united, mesh_->exact, other.mesh_->exact);
  if (!made) return std::nullopt;
  return ExactSolid(std::make_unique<Mesh>(Mesh{*std::move(made)}));
}

std::optional<ExactSolid> ExactSolid::minus(const ExactSolid& other) const {
  auto made = combined(Boolean::minus, mesh_->exact, other.mesh_->exact);
  if (!made) return std::nullopt;
  return ExactSolid(std::make_unique<Mesh>(Mesh{*std::move(made)}));
}

std::size_t ExactSolid::facet_count() const { return mesh_->exact.number_of_faces(); }

SurfaceMesh ExactSolid::rounded() const {
  const ExactMesh& exact = mesh_->exact;
  SurfaceMesh mesh;
  for (const auto v : exact.vertices()) {
    const auto& p = exact.point(v).exact();
    mesh.vertices.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                               CGAL::to_double(p.z()));
  }
  for (const auto f : exact.faces()) {
    auto& triangle = mesh.triangles.emplace_back();
    std::size_t corner = 0;
    for (const auto v : exact.vertices_around_face(exact.halfedge(f))) {
      triangle.at(corner++) = v.idx();
    }
  }
  return mesh;
}

}  // namespace frustum::stock
