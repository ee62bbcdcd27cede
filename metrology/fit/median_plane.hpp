// The plane midway between two faces.
//
// Model    : all of its points are as far from the one plane as from the other. Faces at an angle
//            have two such planes: with sense +1 its normal is along the sum of theirs, with -1
//            along their difference
// Units    : mm
// Shape    : two planes
// Errors   : none
// Accuracy : rounding of doubles
// Source   : ISO 17450-3 (median surface)
#pragma once

#include "metrology/fit/element.hpp"

namespace frustum::metrology {

// Its point is nearest to the middle between theirs.
[[nodiscard]] Plane median_plane(const Plane& first, const Plane& second, double sense);
// The sense for the faces of a slot or a web: between sides that look most alike.
[[nodiscard]] double sense_between(const Vec3& first_normal, const Vec3& second_normal);
// The sense that brings its normal nearest to `direction`, or (`along`) farthest from it, so that
// the plane holds it.
[[nodiscard]] double sense_towards(const Vec3& first_normal, const Vec3& second_normal,
                                   const Vec3& direction, bool along);

}  // namespace frustum::metrology
