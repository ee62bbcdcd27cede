// The polyhedral reference engine of --engine polyhedral.
// Units: mm; frame: workpiece.
// Errors: a program built without CGAL; those of PolyhedralWorkpiece::cut().
#pragma once

#include "core/result.hpp"
#include "core/units.hpp"
#include "stock/mesh/surface_mesh.hpp"
#include "stock/solid/program_state.hpp"

namespace frustum::app {

struct PolyhedralFacets {
  int facets = 64;          // around the axis
  Mm tolerance = Mm{0.01};  // the hulls leave the true sweep by at most this
};

struct FacetedSurface {
  stock::SurfaceMesh mesh{};
  // mm: no vertex is farther than this from the exact surface, normal to it.
  Mm bound{};
};

// What Boolean operations on faceted sweeps leave of the workpiece at its program state. Every
// vertex counts as lying on an edge, because neighbouring facets share them.
[[nodiscard]] Result<FacetedSurface> faceted_surface(const stock::WorkpieceAt& part,
                                                     const PolyhedralFacets& facets);

}  // namespace frustum::app
