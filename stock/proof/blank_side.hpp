// Proof that a point is inside a blank, or outside of it.
//
// Model    : box, frustum and the slabs of a loft are convex: the depth of a point below each face
//            is enclosed.
//            A mesh is asked for its signed distance, which is no proof of ours
// Units    : mm; frame: workpiece
// Errors   : none; a point too near a face, or to where two slabs of a loft meet, is on neither
//            side
// Accuracy : enclosures are a few units in the last place wide; of a mesh 1e-10 mm
#pragma once

#include "core/pose.hpp"
#include "stock/solid/blank.hpp"

namespace frustum::stock {

struct BlankSide {
  bool inside = false;           // surely, and deeper than the margin
  bool outside = false;          // surely, and farther than the margin
  Vec3 outward = Vec3::UnitZ();  // about: across the nearest face
};
[[nodiscard]] BlankSide side_of(const Blank& blank, const Vec3& point, double margin);

}  // namespace frustum::stock
