// Vertices that represent one corner, made one.
//
// Programs that write facets one by one round their common corners each for itself, and rays pass
// through the seam between them.
// Model    : the seam is 1e-9 of the size of the mesh wide, or four units in the last place where
//            all numbers are of single precision, as those of a binary STL are; but no wider than
//            the facets around a corner allow, so that one facet far off leaves the others alone:
//            1e-6 of the longest side of the smallest of them, or four units in the last place of a
//            coordinate 20 sides off. Each vertex that is within the seam of an earlier one, by the
//            narrower of both seams, becomes it; facets that lose a side to it are left out
// Units    : mm, or any
// Shape    : vertices keep their numbers and places, those that nothing names any more too
// Errors   : none
// Accuracy : corners move by the width of the seam at most; a closed mesh stays closed
// Source   : ours
#pragma once

#include <cstddef>

#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

struct WeldedMesh {
  SurfaceMesh mesh{};
  std::size_t moved = 0;        // corners that were apart and became another one
  double farthest = 0.0;        // by so much at most
  std::size_t lost_facets = 0;  // that lost a side
};
[[nodiscard]] WeldedMesh welded(SurfaceMesh mesh);

}  // namespace frustum::stock
