// A closed mesh made finer where the surface bends.
//
// Model    : edges whose middle leaves the exact surface are split there, in rounds. A triangle is
//            bisected across its longest edge first, so that angles stay bounded, and both
//            triangles at an edge split it alike: what is closed and manifold stays so by
//            construction. A new vertex goes onto the exact surface along the normal, or, on a
//            sharp edge, to where its two faces meet
// Units    : mm; frame: that of the solid
// Errors   : a chord tolerance that is not finite and positive; a mesh that is not closed; more
//            than max_triangles
// Accuracy : a surface that bends evenly over a triangle leaves it by at most 4/3 of the worst
//            middle of its edges. Edges are split until their middles are within 0.7 of the
//            tolerance, and the centre of every triangle is asked too
//            (tests/stock/refine_surface_test.cpp). New vertices are as exact as the solid's rays,
//            1 nm, but for those of VertexKind::averaged, on edges that run through a sharp edge of
//            the solid where the coarse mesh has no vertex. Triangles that face inwards are mended
//            (unfold_surface.hpp)
// Threads  : runs on oneTBB; the same bits for any number of threads
// Source   : Rivara 1984, Int. J. Numer. Methods Eng. 20 (bisection across the longest edge)
#pragma once

#include <cstddef>

#include "core/result.hpp"
#include "core/units.hpp"
#include "stock/dexel/tri_dexel_solid.hpp"
#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

struct RefineOptions {
  Mm chord{0.001};  // between vertices the triangles leave the surface by less
  std::size_t max_triangles = 20'000'000;  // about 2 GB while refining
};

// How near a refined surface is to the exact one.
struct Refinement {
  // mm; the largest distance found at the middle of an edge or triangle while refining, before
  // vertices are settled and folds mended. Nothing is known of unresolved ones.
  double worst_chord = 0.0;
  // Edges whose exact surface was not found beside them while refining, each time that one was
  // asked: thinner than the triangles are long.
  std::size_t unresolved_edges = 0;
  // Vertices that are left off the surface, which was not found beside them.
  std::size_t unresolved_vertices = 0;
};

struct RefinedSurface : Refinement {
  SurfaceMesh mesh{};  // without deviations: those of the coarse mesh say nothing here
  int rounds = 0;
};

[[nodiscard]] Result<RefinedSurface> refine_surface(SolidView solid, SurfaceMesh coarse,
                                                    const RefineOptions& options);

}  // namespace frustum::stock
