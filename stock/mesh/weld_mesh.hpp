// Vertices that represent one corner, made one.
//
// Programs that write facets one by one round their common corners each for itself, and rays pass
// through the seam between them.
// Model    : the seam is 1e-9 of the size of the mesh wide, or four units in the last place where
//            all numbers are of single precision, as those of a binary STL are. Each vertex that
//            is within that of an earlier one becomes it; facets that lose a side to it are left
//            out
// Units    : mm, or any
// Shape    : vertices keep their numbers and places, those that nothing names any more too
// Errors   : none
// Accuracy : corners move by the width of the seam at most; a closed mesh stays closed
// Source   : ours
#pragma once

#include "stock/mesh/surface_mesh.hpp"

namespace frustum::stock {

[[nodiscard]] SurfaceMesh welded(SurfaceMesh mesh);

}  // namespace frustum::stock
