// The plane midway between two faces.
//
// Model    : all of its points are as far from the one plane as from the other; of the two such planes of
//            faces at an angle, the one between those sides that look most alike
// Units    : mm
// Shape    : two planes
// Errors   : none
// Accuracy : rounding of doubles
// Source   : ISO 17450-3 (median surface)
#pragma once

#include "metrology/fit/element.hpp"

namespace frustum::metrology {

// Its point lies nearest to the middle between theirs.
[[nodiscard]] Plane median_plane(const Plane& first, const Plane& second);

}  // namespace frustum::metrology
