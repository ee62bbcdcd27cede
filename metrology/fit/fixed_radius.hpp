// Centres of circles and spheres of a given radius: starting values.
//
// Model    : a centre c where sum w (|p - c| - R)^2 is stationary is mean p + R mean (c - p) / |c -
//            p|, never farther than R from the mean. Steps from the left side to the right lower
//            the sum. A radius beyond 1.7 times that of the points pushes the centre off theirs:
//            every direction is tried
// Units    : local frame of size one (normalised_points.hpp), whose origin is the mean
// Shape    : at most `most` centres, best first, a tenth of the part or more from each other
// Errors   : none
// Accuracy : starting values only
// Source   : ours
#pragma once

#include <vector>

#include "metrology/fit/normalised_points.hpp"

namespace frustum::metrology {

// Of circles about `normal`, or of spheres.
[[nodiscard]] std::vector<Vec3> circle_centres(const NormalisedPoints& local,
                                               const UnitVec3& normal, double radius,
                                               std::size_t most);
[[nodiscard]] std::vector<Vec3> sphere_centres(const NormalisedPoints& local, double radius,
                                               std::size_t most);

}  // namespace frustum::metrology
