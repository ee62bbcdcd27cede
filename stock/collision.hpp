// Moves that meet material although they must not: rapids through it, feeds with the spindle off.
//
// Model    : for each such move, rays along X, Y and Z on grids through what the move covers are held
//            against the material that is left at that moment. The cutter is shrunk by a margin, so
//            that a retract along a finished wall is no collision.
// Units    : mm
// Accuracy : overlaps of more than the margin (10 um) that hold a ray of the grid (a twelfth of the
//            cutter's diameter) are found
#pragma once

#include <cstdint>
#include <vector>

#include "stock/workpiece.hpp"

namespace frustum::stock {

enum class CollisionKind : std::uint8_t { rapid_through_material, feed_with_spindle_off };

struct Collision {
  CollisionKind kind = CollisionKind::rapid_through_material;
  std::uint32_t source_line = 0;
  int tool = 0;
  Vec3 point = Vec3::Zero();  // where it is worst
  double depth = 0.0;         // mm of material, across its thinnest direction
};

[[nodiscard]] std::vector<Collision> find_collisions(const Workpiece& workpiece);

}  // namespace frustum::stock
