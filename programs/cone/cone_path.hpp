// The tool path of the cone test as a list of moves: tip and axis in program coordinates.
// Units: mm; frame: program coordinates (table directions, origin in the circle's centre).
#pragma once

#include <vector>

#include "programs/cone/cone_frustum.hpp"
#include "programs/milling/posed_program.hpp"

namespace frustum::programs {

[[nodiscard]] std::vector<PathOperation> cone_path(const ConeFrustum& cone,
                                                   const ConeGeometry& shape);

}  // namespace frustum::programs
