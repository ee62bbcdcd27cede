// How far a walker strays from a line when both are gone along from end to end, forward only: the
// length of the shortest leash between the walker and a partner on the line.
//
// Model    : the distance of Frechet with the walker at its places only; between two of them, and
//            for the line's own corners, nothing is asked. At each place the partner goes no
//            further along the line than a leash makes it go; whether it arrives tells if that
//            leash is long enough, and the shortest one is bisected. The line is straight, or of
//            great circles, between its points
// Units    : mm of places, rad of directions
// Errors   : none; neither walker nor line may be empty
// Accuracy : 1e-6 of the leash
#pragma once

#include <span>

#include "core/pose.hpp"

namespace frustum::calibration {

[[nodiscard]] double leash_of_places(std::span<const Vec3> walker, std::span<const Vec3> line);
// Of unit vectors; neighbours of the line are less than a half turn apart.
[[nodiscard]] double leash_of_directions(std::span<const Vec3> walker, std::span<const Vec3> line);

}  // namespace frustum::calibration
