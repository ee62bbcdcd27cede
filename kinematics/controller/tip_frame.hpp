// The programmed frame under tool-centre-point control or in a tilted plane.
//
// Units : mm; frame: table
// Errors: none
#pragma once

#include "core/pose.hpp"

namespace frustum::kinematics {

struct TipFrame {
  Pose table_from_words{};
  double tool_length = 0.0;  // mm, as the controller knows it
};

}  // namespace frustum::kinematics
