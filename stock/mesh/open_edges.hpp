// Where a mesh does not close.
//
// Model    : of a closed mesh each edge is run as often one way as the other. An edge of which this
//            is not so bounds a hole, or facets that face against each other
// Units    : mm
// Shape    : any indexed triangle mesh; corners of facets that should meet must be one vertex
//            (stock/mesh/weld_mesh.hpp)
// Errors   : none. Precondition: indices are within range
// Accuracy : exact where there are such edges; that there are none is found by a checksum of
//            64 bits
// Source   : ours
#pragma once

#include <cstddef>
#include <optional>

#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

struct OpenEdges {
  std::size_t count = 0;
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();  // of the one whose vertices come first
};
// Nothing: the mesh is closed.
[[nodiscard]] std::optional<OpenEdges> open_edges(const SurfaceMesh& mesh);

}  // namespace frustum::stock
