// From which side the axes come to the poses of a test: what reversal errors look at.
//
// Model  : the play operator of kinematics/path/approach_direction.hpp along the motion of a test,
//          or along straight moves from pose to pose. On a reversal: as the axis comes to it
// Units  : mm, rad
// Errors : none
#pragma once

#include <span>
#include <vector>

#include "instruments/motion_test.hpp"
#include "kinematics/model/geometric_errors.hpp"

namespace frustum::instruments {

// The test with the directions of approach that these errors need; as it is where they need none.
[[nodiscard]] MotionTest with_approach(MotionTest test, const kinematics::GeometricErrors& errors);

// The same for poses that are reached one after the other, from `start` on.
[[nodiscard]] std::vector<TestPose> with_approach(std::vector<TestPose> poses,
                                                  const kinematics::AxisPositions& start,
                                                  const kinematics::GeometricErrors& errors);

}  // namespace frustum::instruments
