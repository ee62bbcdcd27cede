#include "stock/polyhedral/exact_solid.hpp"

// GCC 12 warns of empty function objects inside CGAL's headers, where nothing can be uninitialised.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>

#include <exception>
#include <utility>
#include <vector>

namespace frustum::stock {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<Kernel::Point_3>;

enum class Boolean { united, minus };

// Copies, since the operation refines its operands. Their self-intersections are not looked for:
// hulls have none, and exact results of exact operands neither.
std::optional<ExactMesh> combined(Boolean operation, ExactMesh left, ExactMesh right) {
  ExactMesh result;
  try {
    const bool manifold = operation == Boolean::united
                              ? pmp::corefine_and_compute_union(left, right, result)
                              : pmp::corefine_and_compute_difference(left, right, result);
    if (!manifold) return std::nullopt;
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
