// Straightness of a motion: how far the displacements across a line leave a straight line.
//
// Model    : the range of the distances from a line through the end points, of least squares, or of
//            the minimum zone
// Units    : any of the deviations; positions along the line in any unit
// Shape    : n >= 3 positions, increasing
// Errors   : too few positions
// Accuracy : rounding
// Source   : ISO 230-1 (straightness error), by its name
#pragma once

#include <span>

#include "core/result.hpp"

namespace frustum::instruments {

struct Straightness {
  double least_squares = 0.0;
  double end_points = 0.0;
  double minimum_zone = 0.0;
};

[[nodiscard]] Result<Straightness> straightness_of(std::span<const double> position,
                                                   std::span<const double> deviation);

}  // namespace frustum::instruments
