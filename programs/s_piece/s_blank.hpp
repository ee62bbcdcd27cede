// The near-net blank of an S-shaped piece as a closed mesh.
//
// Model    : the wall with 0.3 mm on both flanks, from u = 0 to 1 and up to z = height, on a box
//            whose top is 8 mm below curve C0, or so much that no cutter reaches it
// Units    : mm; frame: workpiece
// Shape    : 100 facets' widths along a flank, 4 up a ruling
// Errors   : flanks that cross each other, or themselves
// Accuracy : flanks within 0.07 mm of what is said
// Source   : ours
#pragma once

#include "core/result.hpp"
#include "programs/s_piece/s_piece.hpp"
#include "stock/solid/blank.hpp"

namespace frustum::programs {

// `reach`: how far below curve C0 the leaning cutter gets.
[[nodiscard]] Result<stock::MeshShape> s_blank(const SGeometry& shape, double reach);

}  // namespace frustum::programs
