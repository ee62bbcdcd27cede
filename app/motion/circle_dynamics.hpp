// What masses and springs of the machine move the tip by on a circle at a feed.
//
// Model    : the circle is run two turns before the one that counts, so that the start has died
//            away; the deviation of dynamics/path_response.hpp at each angle
// Units    : mm, rad, mm/s; frame: table
// Shape    : a deviation for each angle of the circle
// Errors   : none: motion_dynamics.hpp has looked for them
// Accuracy : that of path_response.hpp (tests/app/motion_dynamics_test.cpp)
// Source   : ISO 230-4 circular deviations of the moving machine
#pragma once

#include <vector>

#include "dynamics/path_deviation.hpp"
#include "instruments/circle_test.hpp"

namespace frustum::app {

[[nodiscard]] std::vector<Vec3> circle_deviations(const dynamics::DynamicModel& model,
                                                  dynamics::PathMethod method,
                                                  const instruments::CircleTest& circle,
                                                  const instruments::MotionTest& test, double feed);

}  // namespace frustum::app
