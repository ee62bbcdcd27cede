// A surface without triangles that face inwards.
//
// Model    : a triangle faces inwards when its normal is against the mean of the exact normals at
//            its corners, or, where these are of both faces of a blade, against all of them.
//            At sharp edges of thin blades, where vertices of neighbouring cells change places
//            along the edge, such triangles fold over their neighbours. For each, the diagonals of
//            its edges are exchanged or one of its corners goes to a neighbour, whichever leaves
//            the triangles there nearest to the exact normals. Vertices are kept or removed, never
//            moved; edges and corners of the solid are removed only where nothing else does.
//            Flakes of four triangles that are inside out go
// Units    : mm
// Shape    : closed and 2-manifold before and after; a mesh that is not is left as it is
// Errors   : none; inward_triangles() counts what is left (tests/stock/unfold_surface_test.cpp)
// Threads  : looks on oneTBB, mends on one; the same bits for any number of threads
#pragma once

#include <cstddef>

#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

void unfold_surface(SurfaceMesh& mesh);

// How many triangles face inwards. Precondition: the mesh has normals and kinds.
[[nodiscard]] std::size_t inward_triangles(const SurfaceMesh& mesh);

}  // namespace frustum::stock
