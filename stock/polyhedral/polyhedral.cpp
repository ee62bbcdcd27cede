#include "stock/polyhedral/polyhedral.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "stock/polyhedral/convex_hull.hpp"
#include "stock/polyhedral/exact_solid.hpp"
#include "stock/polyhedral/polyhedral_sweep.hpp"
#include "stock/solid/facet_solid.hpp"

namespace frustum::stock {
namespace {

using std::numbers::pi;

SurfaceMesh mesh_of(const FacetSolid& solid, const Vec3& origin) {
  SurfaceMesh mesh;
  for (const Vec3& v : solid.vertices()) mesh.vertices.push_back(origin + v);
  mesh.triangles.assign(solid.facets().begin(), solid.facets().end());
  return mesh;
}

// The union of pieces [first, last) by halves: neighbours in program order overlap, and expressions
// stay shallow. Solids whose union would not be a manifold stay apart.
std::vector<ExactSolid> union_of(const std::vector<ConvexPiece>& pieces, std::size_t first,
                                 std::size_t last) {
  std::vector<ExactSolid> solids;
  if (first == last) return solids;
  if (last - first == 1) {
    solids.emplace_back(convex_hull(pieces[first]));
    return solids;
  }
  const std::size_t middle = first + (last - first) / 2;
  solids = union_of(pieces, first, middle);
  for (ExactSolid& next : union_of(pieces, middle, last)) {
    std::optional<ExactSolid> both = solids.back().united(next);
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
  FacetSolid facets;
  std::size_t pieces;
};

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
  std::vector<ExactSolid> blanks;
  if (const auto* mesh = std::get_if<MeshShape>(&blank.shape())) {
    blanks.emplace_back(mesh_of(*mesh->solid, blank.origin()));
  } else {
    const std::vector<ConvexPiece> blank_pieces = faceted(blank, options.facets);
    blanks = union_of(blank_pieces, 0, blank_pieces.size());
  }
  if (blanks.size() != 1) {
    return error("polyhedral-blank"_id,
                 "the faceted blank is not a closed surface without self-contact",
                 "make successive sections of the loft overlap in an area");
  }
  ExactSolid solid = std::move(blanks.front());
  for (const ExactSolid& removed : union_of(*pieces, 0, pieces->size())) {
    std::optional<ExactSolid> left = solid.minus(removed);
    if (!left) {
      return error("polyhedral-difference"_id,
                   fmt::format("the difference of two faceted solids ({} and {} facets) is not a "
                               "closed surface without self-contact",
                               solid.facet_count(), removed.facet_count()),
                   "another number of facets moves the surfaces apart where they touch");
    }
    solid = std::move(*left);
  }
  SurfaceMesh left = solid.rounded();
  return PolyhedralWorkpiece(std::make_shared<const Solid>(
      Solid{FacetSolid(std::move(left.vertices), std::move(left.triangles)), pieces->size()}));
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
