// Whether a controller that goes straight in the output's words keeps to the programmed path.
//
// Units  : mm, rad
// Errors : none
#pragma once

#include "post/planning/plan_state.hpp"
#include "post/planning/planned_block.hpp"

namespace frustum::post {

// From where the axes are to `end`, where the part ends; `depth`: how often the block has been
// halved.
[[nodiscard]] bool keeps_to_path(const PlanState& state, const BlockPart& part,
                                 const kinematics::AxisPositions& end, int depth);

}  // namespace frustum::post
