// Why a mesh is not the surface of one body.
//
// Model    : a body is bounded by one outer shell, counter-clockwise seen from outside, and any
//            number of voids within it. Told are holes, edges and corners that are no manifold,
//            facets against each other, crossing facets, inside-out and several shells
// Units    : mm
// Errors   : one diagnostic a fault, with its count and the place of the first; nothing: a body
// Accuracy : crossings are decided with exact predicates
// Source   : CGAL 5.5, Polygon Mesh Processing (self_intersections, extract_boundary_cycles,
//            volume_connected_components)
#pragma once

#include "core/diagnostic.hpp"
#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

[[nodiscard]] Diagnostics mesh_faults(const SurfaceMesh& mesh);

}  // namespace frustum::stock
