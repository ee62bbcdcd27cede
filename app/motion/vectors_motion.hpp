// frustum motion vectors: location errors of rotary axes as the vectors by which a control corrects
// its kinematics.
//
// Units  : mm and um, unit vectors and urad in the document
// Errors : of words and machine; a machine without rotary axes
#pragma once

#include "app/motion/motion_answer.hpp"

namespace frustum::app {

[[nodiscard]] Result<MotionAnswer> vectors_answer(const MotionWords& words);

}  // namespace frustum::app
