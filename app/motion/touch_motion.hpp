// frustum motion touch: touch-trigger calibration of a table's axes A and C.
//
// Units  : mm, um in the words; --noise is two standard deviations of a touch
// Errors : of words, machine and touches
#pragma once

#include "app/motion/motion_answer.hpp"

namespace frustum::app {

constexpr int kMostCalibrations = 100000;  // seconds

struct TouchWords : MotionWords {
  int repeat = 1;  // calibrations whose scatter is shown
  LobeWords lobes{};
};

[[nodiscard]] Result<MotionAnswer> touch_answer(const TouchWords& words);

}  // namespace frustum::app
