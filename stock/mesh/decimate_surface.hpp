// A closed mesh with fewer triangles, within a tolerance of what it was.
//
// Model    : edges are collapsed, cheapest first (error quadrics), as long as every vertex that was
//            taken away stays within half the tolerance of the triangles, and the centres
//            of these within the tolerance of the given mesh. Vertices are kept or removed,
//            never moved: those that stay lie as exactly as before and keep their normals and
//            deviations. Corners stay; a vertex of a sharp edge may only go along that edge.
//            Every collapse has a bound: seen along the mean normal, by how much the triangles
//            around the vertex depart from those before. Where their sum is within half the
//            tolerance, all points of the surface are, and nothing else is asked
// Units    : mm
// Errors   : a tolerance that is not finite and positive; a mesh that is not closed and manifold
// Accuracy : vertices and centres are checked, as above; that triangles then are within the
//            tolerance all over is measured, not proven, where the sum of the bounds is above
//            half of it (tests/stock/refine_surface_test.cpp)
// Source   : Garland and Heckbert 1997, SIGGRAPH (quadrics); the bounds and the blocks are our own
// Threads  : runs on oneTBB, a block of the surface each (stock/mesh/surface_blocks.hpp); the same
//            bits for any number of threads
#pragma once

#include "core/result.hpp"
#include "core/units.hpp"
#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

[[nodiscard]] Result<SurfaceMesh> decimate_surface(const SurfaceMesh& mesh, Mm tolerance);

}  // namespace frustum::stock
