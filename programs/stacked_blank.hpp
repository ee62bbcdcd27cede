// A blank of levels one upon the other, each smaller than the one below, as a closed mesh.
//
// Model  : a level is a prism over an outline that every ray from the axis meets once; between two
//          of them is a level ledge. A bore may go through all of them. All outlines have corners
//          in the same directions, so that walls and ledges are rows of quadrangles
// Units  : mm; frame: workpiece, the axis is Z
// Shape  : outlines of three corners or more, counter-clockwise seen from above
// Errors : none; each outline must hold the axis and be within the one below
// Source : ours
#pragma once

#include <vector>

#include "stock/solid/facet_solid.hpp"

namespace frustum::programs {

using Outline = std::vector<Vec3>;  // z does not count

struct StackLevel {
  Outline outline{};
  double bottom = 0.0;  // z
};

// Levels from the top, which is at z = `top`, down; an empty `bore` is none.
[[nodiscard]] stock::FacetSolid stacked_blank(const std::vector<StackLevel>& levels, double top,
                                              const Outline& bore);

}  // namespace frustum::programs
