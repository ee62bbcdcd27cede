// Axis solutions along a path, each the nearest to the one before.
//
// Units  : mm, rad; frame: table
// Errors : a direction that the machine does not reach, a pose that no solution reaches within
//          travel
#pragma once

#include <span>
#include <vector>

#include "kinematics/model/rotary_plan.hpp"

namespace frustum::post {

[[nodiscard]] Result<std::vector<kinematics::PlannedPose>> nearest_plan(
    const kinematics::Machine& machine, std::span<const kinematics::ToolPose> path,
    double tool_length, const kinematics::PlanOptions& options);

}  // namespace frustum::post
