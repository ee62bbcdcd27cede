// Harmonics of a trace over a rotary axis or a cone, as a document and for a terminal.
//
// Units  : um, as named
// Errors : too few angles are a warning, the value null
#pragma once

#include "app/motion/motion_answer.hpp"

namespace frustum::app {

// `angle_name`: "C", "phi".
void add_turn_evaluation(MotionAnswer& answer, const std::string& angle_name,
                         const std::vector<double>& angles, const std::vector<double>& readings);

}  // namespace frustum::app
