// The cutter as Boolean programs need it: with facets, hulled over every block of the path.
//
// Units    : mm; frame: workpiece
// Shape    : the hull of the points of a block is what is removed by it
// Errors   : none
// Accuracy : regular polygons around the axis, as far outside the circle as inside: within half of
//            r (1 - cos(pi / facets)), the best that so many facets can do. On a ball, as many
//            facets a quarter along its meridian. A polygon that has a vertex where the path
//            touches the flank is inscribed instead: it is exact there, but only a path whose
//            contact is known beforehand can be cut so
#pragma once

#include <vector>

#include "bench/peers/scene.hpp"

namespace frustum::bench {

enum class Facing {
  fixed,    // the first vertex in one direction of the workpiece, as good as any
  contact,  // a vertex towards the Z axis of the workpiece, where the cone's flank is
};

[[nodiscard]] std::vector<std::vector<Vec3>> hulls_of_blocks(const PeerScene& scene, int facets,
                                                             Facing facing);

}  // namespace frustum::bench
