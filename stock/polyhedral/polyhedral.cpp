#include "stock/polyhedral/polyhedral.hpp"

// GCC 12 warns of empty function objects inside CGAL's headers, where nothing can be uninitialised.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "stock/polyhedral/polyhedral_sweep.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::stock {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using std::numbers::pi;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Doubles = CGAL::Exact_predicates_inexact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<Exact::Point_3>;
using DoubleMesh = CGAL::Surface_mesh<Doubles::Point_3>;

Doubles::Point_3 to_point(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

ExactMesh hull_of(const ConvexPiece& piece) {
  std::vector<Doubles::Point_3> points;
  points.reserve(piece.size());
  for (const Vec3& p : piece) points.push_back(to_point(p));
  DoubleMesh hull;
  CGAL::convex_hull_3(points.begin(), points.end(), hull);
  ExactMesh mesh;
  std::vector<ExactMesh::Vertex_index> copies(hull.num_vertices());
  for (const auto v : hull.vertices()) {
    const Doubles::Point_3& p = hull.point(v);
    copies[v.idx()] = mesh.add_vertex({p.x(), p.y(), p.z()});
  }
  for (const auto f : hull.faces()) {
    std::vector<ExactMesh::Vertex_index> corners;
    for (const auto v : hull.vertices_around_face(hull.halfedge(f)))
      corners.push_back(copies[v.idx()]);
    mesh.add_face(corners);
  }
  return mesh;
}

// Evaluates what the lazy kernel has put off, so that its expressions do not grow with every cut.
void settle(ExactMesh& mesh) {
  for (const auto v : mesh.vertices()) mesh.point(v).exact();
}

enum class Boolean { united, minus };

// Nothing when the result would not be a manifold, or the operation gives up.
std::optional<ExactMesh> combined(Boolean operation, ExactMesh left, ExactMesh right) {
  ExactMesh result;
  try {
    // No check for self-intersections: hulls have none, and exact results of exact operands
    // neither.
    const bool manifold = operation == Boolean::united
                              ? pmp::corefine_and_compute_union(left, right, result)
                              : pmp::corefine_and_compute_difference(left, right, result);
    if (!manifold) return std::nullopt;
    result.collect_garbage();
    settle(result);
  } catch (const std::exception&) {  // a precondition of CGAL
    return std::nullopt;
  }
  return result;
}

ExactMesh mesh_of(const FacetSolid& solid, const Vec3& origin) {
  ExactMesh mesh;
  std::vector<ExactMesh::Vertex_index> copies;
  for (const Vec3& v : solid.vertices()) {
    const Vec3 p = origin + v;
    copies.push_back(mesh.add_vertex({p.x(), p.y(), p.z()}));
  }
  for (const auto& [a, b, c] : solid.facets()) mesh.add_face(copies[a], copies[b], copies[c]);
  return mesh;
}

// The union of pieces [first, last) by halves: neighbours in program order overlap, and expressions
// stay shallow. Solids whose union would not be a manifold stay apart.
std::vector<ExactMesh> union_of(const std::vector<ConvexPiece>& pieces, std::size_t first,
                                std::size_t last) {
  std::vector<ExactMesh> solids;
  if (first == last) return solids;
  if (last - first == 1) {
    solids.push_back(hull_of(pieces[first]));
    return solids;
  }
  const std::size_t middle = first + (last - first) / 2;
  solids = union_of(pieces, first, middle);
  for (ExactMesh& next : union_of(pieces, middle, last)) {
    std::optional<ExactMesh> both = combined(Boolean::united, solids.back(), next);
    if (both) {
      solids.back() = std::move(*both);
    } else {
      solids.push_back(std::move(next));
    }
  }
  return solids;
}

// Convex bodies whose union is the blank.
std::vector<ConvexPiece> faceted(const Blank& blank, int facets) {
  if (const auto* loft = std::get_if<LoftShape>(&blank.shape())) {
    std::vector<ConvexPiece> pieces;
    for (const LoftSlab& slab : slabs_of(*loft)) {
      ConvexPiece& corners = pieces.emplace_back();
      for (int i = 0; i < 8; ++i) {
        const LoftSection& s = i & 4 ? slab.top : slab.bottom;
        corners.push_back(blank.origin() + Vec3((i & 1 ? 0.5 : -0.5) * s.size_x,
                                                (i & 2 ? 0.5 : -0.5) * s.size_y, s.z));
      }
    }
    return pieces;
  }
  ConvexPiece corners;
  if (const auto* box = std::get_if<BoxShape>(&blank.shape())) {
    for (int i = 0; i < 8; ++i) {
      corners.push_back(blank.origin() + Vec3((i & 1 ? 0.5 : -0.5) * box->size_x,
                                              (i & 2 ? 0.5 : -0.5) * box->size_y,
                                              i & 4 ? box->height : 0.0));
    }
    return {corners};
  }
  const auto& round = std::get<FrustumShape>(blank.shape());
  for (int j = 0; j < facets; ++j) {
    const double angle = 2.0 * pi * j / facets;
    const Vec3 across(std::cos(angle), std::sin(angle), 0.0);
    corners.push_back(blank.origin() + round.bottom_radius * across);
    corners.push_back(blank.origin() + round.top_radius * across + round.height * Vec3::UnitZ());
  }
  return {corners};
}

}  // namespace

struct PolyhedralWorkpiece::Solid {
  Solid(const ExactMesh& mesh, std::size_t piece_total);

  FacetSolid facets;
  std::size_t pieces;
};

PolyhedralWorkpiece::Solid::Solid(const ExactMesh& mesh, std::size_t piece_total)
    : pieces(piece_total) {
  std::vector<Vec3> vertices;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v).exact();
    vertices.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }
  std::vector<Facet> corners;
  for (const auto f : mesh.faces()) {
    Facet facet{};
    std::size_t corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) facet.at(corner++) = v.idx();
    corners.push_back(facet);
  }
  facets = FacetSolid(std::move(vertices), std::move(corners));
}

Mm polyhedral_bound(const PolyhedralOptions& options, Mm radius) {
  const double vertex =
      1.0 / (std::cos(pi / options.facets) * std::cos(pi / (4.0 * options.arc_facets)));
  return radius * (vertex - 1.0) + options.tolerance;
}

Result<PolyhedralWorkpiece> PolyhedralWorkpiece::cut(const Blank& blank,
                                                     const kinematics::ToolPath& path,
                                                     const std::map<int, cutter::Cutter>& cutters,
                                                     const PolyhedralOptions& options) {
  if (options.facets < 3) {
    return error("polyhedral-facets"_id, fmt::format("{} facets around the axis", options.facets),
                 "at least 3 make a solid");
  }
  if (options.arc_facets < 1) {
    return error("polyhedral-facets"_id,
                 fmt::format("{} facets on a quarter circle", options.arc_facets), "at least 1");
  }
  if (!(options.tolerance.value > 0.0) || !std::isfinite(options.tolerance.value)) {
    return error("polyhedral-facets"_id,
                 fmt::format("facet tolerance {} mm", options.tolerance.value),
                 "it must be a finite number above 0");
  }
  auto pieces = faceted_sweep(path, cutters, blank.bounds(), options);
  if (!pieces) return std::move(pieces).error();
  std::vector<ExactMesh> blanks;
  if (const auto* mesh = std::get_if<MeshShape>(&blank.shape())) {
    blanks.push_back(mesh_of(*mesh->solid, blank.origin()));
  } else {
    const std::vector<ConvexPiece> blank_pieces = faceted(blank, options.facets);
    blanks = union_of(blank_pieces, 0, blank_pieces.size());
  }
  if (blanks.size() != 1) {
    return error("polyhedral-blank"_id,
                 "the faceted blank is not a closed surface without self-contact",
                 "make successive sections of the loft overlap in an area");
  }
  ExactMesh solid = std::move(blanks.front());
  for (const ExactMesh& removed : union_of(*pieces, 0, pieces->size())) {
    std::optional<ExactMesh> left = combined(Boolean::minus, solid, removed);
    if (!left) {
      return error("polyhedral-difference"_id,
                   fmt::format("the difference of two faceted solids ({} and {} facets) is not a "
                               "closed surface without self-contact",
                               solid.number_of_faces(), removed.number_of_faces()),
                   "another number of facets moves the surfaces apart where they touch");
    }
    solid = std::move(*left);
  }
  return PolyhedralWorkpiece(std::make_shared<const Solid>(solid, pieces->size()));
}

IntervalSet PolyhedralWorkpiece::material_along(const Ray& ray, RaySpan span) const {
  return solid_->facets.along(ray, span);
}

SurfacePoint PolyhedralWorkpiece::surface_at(const Ray& ray, double s, EndTag tag) const {
  SurfacePoint found{.s = s, .point = ray.at(s), .normal = -ray.direction};
  if (tag >= 0) found.normal = solid_->facets.normal(tag);
  return found;
}

double PolyhedralWorkpiece::volume() const { return solid_->facets.volume(); }
std::span<const Vec3> PolyhedralWorkpiece::vertices() const { return solid_->facets.vertices(); }
std::span<const PolyhedralWorkpiece::Facet> PolyhedralWorkpiece::facets() const {
  return solid_->facets.facets();
}
std::size_t PolyhedralWorkpiece::piece_count() const { return solid_->pieces; }

}  // namespace frustum::stock
