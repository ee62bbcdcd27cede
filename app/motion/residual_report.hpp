// What is left over of the readings of a calibration: whether they agree, and which one does not.
//
// Units  : um, as named
// Errors : none; readings that do not agree are a warning with place and remedy
#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/motion/motion_answer.hpp"
#include "instruments/touch_plan.hpp"

namespace frustum::app {

// Readings of touches, outward. `noise`: of one standard deviation, mm; 0: not stated.
void add_touch_residuals(MotionAnswer& answer, const instruments::TouchPlan& plan,
                         std::span<const double> readings, double noise);

// Of R-tests, a list a ball. `names`: what to call the balls, as their files.
void add_ball_residuals(MotionAnswer& answer, const instruments::TouchPlan& plan,
                        std::span<const Vec3> balls, const std::vector<std::vector<Vec3>>& readings,
                        const std::vector<std::string>& names, double noise);

}  // namespace frustum::app
