#include "stock/polyhedral.hpp"

// GCC 12 warns of empty function objects inside CGAL's headers, where nothing can be uninitialised.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
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

#include "stock/polyhedral_sweep.hpp"

namespace frustum::stock {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using std::numbers::pi;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Doubles = CGAL::Exact_predicates_inexact_constructions_kernel;
using ExactMesh = CGAL::Surface_mesh<Exact::Point_3>;
using DoubleMesh = CGAL::Surface_mesh<Doubles::Point_3>;
using Rational = CGAL::Exact_rational;
using Triangles = std::vector<Doubles::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Doubles, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Doubles, Primitive>>;

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

// Where the segment from a to b crosses a triangle.
struct Crossing {
  double fraction = 0.0;  // of the way from a to b
  bool enters = false;
  EndTag facet = -1;
};

Rational signed_volume(const Doubles::Triangle_3& t, const Doubles::Point_3& apex) {
  const auto difference = [](const Doubles::Point_3& from, const Doubles::Point_3& to) {
    return std::array<Rational, 3>{Rational(to.x()) - Rational(from.x()),
                                   Rational(to.y()) - Rational(from.y()),
                                   Rational(to.z()) - Rational(from.z())};
  };
  const auto u = difference(t[0], t[1]);
  const auto v = difference(t[0], t[2]);
  const auto w = difference(t[0], apex);
  return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] +
         (u[0] * v[1] - u[1] * v[0]) * w[2];
}

}  // namespace

struct PolyhedralWorkpiece::Solid {
  Solid(const ExactMesh& mesh, const BoundingBox& bounds, std::size_t piece_total);

  // Every crossing of the segment, or nothing when it meets an edge exactly.
  [[nodiscard]] std::optional<std::vector<Crossing>> crossings(const Vec3& a, const Vec3& b) const;

  std::vector<Vec3> vertices;
  std::vector<Facet> facets;
  BoundingBox box;
  std::size_t pieces;
  Triangles triangles;
  Tree tree;
};

PolyhedralWorkpiece::Solid::Solid(const ExactMesh& mesh, const BoundingBox& bounds,
                                  std::size_t piece_total)
    : box(bounds), pieces(piece_total) {
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v).exact();
    vertices.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
  }
  for (const auto f : mesh.faces()) {
    Facet facet{};
    std::size_t corner = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) facet.at(corner++) = v.idx();
    const Doubles::Triangle_3 triangle(to_point(vertices[facet[0]]), to_point(vertices[facet[1]]),
                                       to_point(vertices[facet[2]]));
    facets.push_back(facet);
    triangles.push_back(triangle);
  }
  tree.insert(triangles.cbegin(), triangles.cend());
  if (!triangles.empty())
    tree.build();  // now, not at the first question: questions come in parallel
}

std::optional<std::vector<Crossing>> PolyhedralWorkpiece::Solid::crossings(const Vec3& a,
                                                                           const Vec3& b) const {
  const Doubles::Point_3 start = to_point(a);
  const Doubles::Point_3 end = to_point(b);
  std::vector<Tree::Primitive_id> met;
  tree.all_intersected_primitives(Doubles::Segment_3(start, end), std::back_inserter(met));
  std::vector<Crossing> found;
  for (const auto& triangle : met) {
    const auto turn = [&](int i, int j) {
      return CGAL::orientation(start, end, (*triangle)[i], (*triangle)[j]);
    };
    const CGAL::Orientation side = turn(0, 1);
    if (side == CGAL::COPLANAR || turn(1, 2) == CGAL::COPLANAR || turn(2, 0) == CGAL::COPLANAR) {
      // Rounding may have flattened a triangle; its neighbours close the gap.
      if (triangle->is_degenerate()) continue;
      return std::nullopt;
    }
    if (turn(1, 2) != side || turn(2, 0) != side) continue;
    const Rational at_start = signed_volume(*triangle, start);
    const Rational at_end = signed_volume(*triangle, end);
    found.push_back({CGAL::to_double(Rational(at_start / (at_start - at_end))), at_start > 0,
                     static_cast<EndTag>(triangle - triangles.cbegin())});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Crossing& x, const Crossing& y) { return x.fraction < y.fraction; });
  return found;
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
    return error(fmt::format("{} facets around the axis", options.facets),
                 "at least 3 make a solid");
  }
  if (options.arc_facets < 1) {
    return error(fmt::format("{} facets on a quarter circle", options.arc_facets), "at least 1");
  }
  if (!(options.tolerance.value > 0.0) || !std::isfinite(options.tolerance.value)) {
    return error(fmt::format("facet tolerance {} mm", options.tolerance.value),
                 "it must be a finite number above 0");
  }
  auto pieces = faceted_sweep(path, cutters, blank.bounds(), options);
  if (!pieces) return std::move(pieces).error();
  const std::vector<ConvexPiece> blank_pieces = faceted(blank, options.facets);
  std::vector<ExactMesh> blanks = union_of(blank_pieces, 0, blank_pieces.size());
  if (blanks.size() != 1) {
    return error("the faceted blank is not a closed surface without self-contact",
                 "make successive sections of the loft overlap in an area");
  }
  ExactMesh solid = std::move(blanks.front());
  for (const ExactMesh& removed : union_of(*pieces, 0, pieces->size())) {
    std::optional<ExactMesh> left = combined(Boolean::minus, solid, removed);
    if (!left) {
      return error(fmt::format("the difference of two faceted solids ({} and {} facets) is not a "
                               "closed surface without self-contact",
                               solid.number_of_faces(), removed.number_of_faces()),
                   "another number of facets moves the surfaces apart where they touch");
    }
    solid = std::move(*left);
  }
  return PolyhedralWorkpiece(std::make_shared<const Solid>(solid, blank.bounds(), pieces->size()));
}

IntervalSet PolyhedralWorkpiece::material_along(const Ray& ray, RaySpan span) const {
  const Vec3 centre = 0.5 * (solid_->box.min + solid_->box.max);
  const double radius = 0.5 * (solid_->box.max - solid_->box.min).norm() + 1.0;
  const double middle = (centre - ray.origin).dot(ray.direction);
  if ((centre - ray.at(middle)).norm() > radius || facets().empty()) return {};
  const Vec3 across = perpendicular_to(ray.direction);

  std::optional<std::vector<Crossing>> crossings;
  for (int attempt = 0; !crossings; ++attempt) {
    // Each attempt in another direction; no two lie on one edge.
    constexpr double kAside = 1e-9;  // mm
    const double angle = 2.4 * attempt;
    const Vec3 aside =
        attempt == 0
            ? Vec3(Vec3::Zero())
            : Vec3(attempt * kAside *
                   (std::cos(angle) * across + std::sin(angle) * ray.direction.cross(across)));
    crossings = solid_->crossings(ray.at(middle - radius) + aside, ray.at(middle + radius) + aside);
  }
  std::vector<Interval> material;
  int depth = 0;
  Interval open;
  for (const Crossing& crossing : *crossings) {
    const double s = middle - radius + 2.0 * radius * crossing.fraction;
    const int before = depth;
    depth += crossing.enters ? 1 : -1;
    if (before == 0 && depth == 1) {
      open.lo = s;
      open.lo_tag = crossing.facet;
    } else if (before == 1 && depth == 0) {
      open.hi = s;
      open.hi_tag = crossing.facet;
      material.push_back(open);
    }
  }
  return IntervalSet(std::move(material)).intersected(IntervalSet({{span.lo, span.hi}}));
}

SurfacePoint PolyhedralWorkpiece::surface_at(const Ray& ray, double s, EndTag tag) const {
  SurfacePoint found{.s = s, .point = ray.at(s), .normal = -ray.direction};
  if (tag < 0) return found;
  const Facet& facet = solid_->facets[static_cast<std::size_t>(tag)];
  const Vec3& corner = solid_->vertices[facet[0]];
  const Vec3 u = solid_->vertices[facet[1]] - corner;
  const Vec3 v = solid_->vertices[facet[2]] - corner;
  if (const auto normal = UnitVec3::of(u.cross(v))) found.normal = *normal;
  return found;
}

double PolyhedralWorkpiece::volume() const {
  // From the centre, so that little cancels.
  const Vec3 centre = 0.5 * (solid_->box.min + solid_->box.max);
  double six_fold = 0.0;
  for (const Facet& facet : solid_->facets) {
    const Vec3 a = solid_->vertices[facet[0]] - centre;
    const Vec3 b = solid_->vertices[facet[1]] - centre;
    const Vec3 c = solid_->vertices[facet[2]] - centre;
    six_fold += a.dot(b.cross(c));
  }
  return six_fold / 6.0;
}

std::span<const Vec3> PolyhedralWorkpiece::vertices() const { return solid_->vertices; }
std::span<const PolyhedralWorkpiece::Facet> PolyhedralWorkpiece::facets() const {
  return solid_->facets;
}
std::size_t PolyhedralWorkpiece::piece_count() const { return solid_->pieces; }

}  // namespace frustum::stock
