// The vertices of all cells, and the surface that joins them.
//
// Model    : the rays of neighbouring cells share what may have cut there. Blocks of cells whose
//            crossings are known, and whose rays nothing new reaches, keep their vertices: what a
//            ray finds does not depend on segments that cover nothing of it
//            (cutter/search/group_search.hpp). A vertex that leaves its cell may come too near to
//            that of another piece; it then goes back to its own cell, which depends on all
//            vertices around and is done for all of them, last
// Units    : mm; frame: that of the solid
// Errors   : none
// Threads  : runs on oneTBB; the same bits for any number of threads
#pragma once

#include <array>
#include <map>
#include <vector>

#include "core/box.hpp"
#include "stock/dexel/reached_rays.hpp"
#include "stock/dexel/tri_dexel_solid.hpp"
#include "stock/mesh/surface_mesh.hpp"
#include "stock/mesh/surface_mesh_cells.hpp"
#include "stock/mesh/surface_mesh_crossings.hpp"

namespace frustum::stock {

// As long as Cells::vertex_count(), and numbered as they are there.
struct PlacedVertices {
  std::vector<Vec3> points{};
  std::vector<Vec3> normals{};
  std::vector<VertexKind> kinds{};
  // A block of cells: how many have surface, and the box of all rays asked for their vertices.
  struct Block {
    std::size_t cells = 0;
    Box asked{};
    std::size_t kept = 0;  // vertices that were known
  };
  std::vector<std::map<std::array<int, 3>, Block>> blocks{};  // by lowest cell; in columns

  [[nodiscard]] std::size_t kept() const;
};

// What was found of a solid that differs from this one only where new cuts reach.
struct KnownVertices {
  const Cells* cells = nullptr;
  const PlacedVertices* placed = nullptr;
  const ReachedRays* reached = nullptr;
};

// `known`: of the solid whose crossings were known to `crossings`, if any.
[[nodiscard]] PlacedVertices place_vertices(SolidView solid, const Crossings& crossings,
                                            const Cells& cells, const KnownVertices& known = {});

// Vertices that have left their cell and are too near to others go back.
void keep_apart(SolidView solid, const Crossings& crossings, const Cells& cells,
                PlacedVertices& placed);

// Keeps them apart, joins them and unfolds what they make.
[[nodiscard]] SurfaceMesh surface_of(SolidView solid, const Crossings& crossings,
                                     const Cells& cells, PlacedVertices placed);

}  // namespace frustum::stock
