// The distance of Frechet of two polygonal lines: the length of the shortest leash between two
// walkers who go along them from end to end, each forward only.
//
// Model    : the free space of H. Alt and M. Godau, "Computing the Frechet distance between two
//            polygonal curves" (1995): for a leash, which places of both lines can be reached
//            together; bisected to 1e-9
// Errors   : none; neither may be empty
#pragma once

#include <vector>

#include "core/pose.hpp"

namespace frustum::calibration {

[[nodiscard]] double frechet_distance(std::vector<Vec3> a, std::vector<Vec3> b);

}  // namespace frustum::calibration
