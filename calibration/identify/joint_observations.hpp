// Parts and motion tests of one machine in one estimate.
//
// Model    : rows of the parts, then those of the tests, which share no noise; unknowns of the
//            parts are the first of the tests' (motion_observations.hpp), so that parts do not
//            answer to the balls in the spindle
// Units    : mm, rad
// Shape    : either may be empty
// Errors   : those of the models
// Source   : JCGM 102:2011, section 6
#pragma once

#include "calibration/identify/motion_observations.hpp"
#include "calibration/identify/piece_observations.hpp"

namespace frustum::calibration {

[[nodiscard]] PieceObservations joint_observations(PieceObservations pieces,
                                                   MotionObservations motions);

}  // namespace frustum::calibration
