// How far a generatrix surely is from places along a straight line on the meridian.
//
// Model    : the places are on the line from one to another, or beside it in radius by no more than
//            is said: as those of a point that a cutter of revolution moves by. A line that is
//            nearly level is made longer by that; of another it is taken off. Of an arc its circle
//            counts
// Units    : mm; frame: tool (meridian)
// Errors   : none; 0 or less where nothing is sure
// Accuracy : within rounding (1e-12 mm) no more than the true distance
#pragma once

#include "cutter/body/generatrix.hpp"

namespace frustum::cutter {

[[nodiscard]] double clearance_along(const Generatrix& generatrix, const MeridianPoint& a,
                                     const MeridianPoint& b, double aside);

}  // namespace frustum::cutter
