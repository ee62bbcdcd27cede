// Which of its axis solutions a five-axis path takes at each pose.
//
// Model    : every pose has a few solutions (two orientations, each shifted by full turns within travel);
//            the plan is the cheapest way through them: least rotary travel, no over-travel, away from the
//            pole where the first rotary axis would have to race; through the pole it changes the sign of
//            the tilt axis instead of spinning the table (the alpha = beta rule); where no way stays
//            within travel it unwinds with the tool retracted
// Units    : mm, rad; frame: table
// Errors   : a pose that no solution reaches within travel, with its index and the axis that is in the way
// Source   : dynamic programming over the solutions; pole rule: ETH thesis on a five-axis test piece
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "kinematics/machine.hpp"
#include "kinematics/tool_path.hpp"

namespace frustum::kinematics {

struct PlanOptions {
  AxisPositions start{};                     // where the axes are before the first pose
  std::optional<AxisPositions> preferred{};  // rotary positions to begin near, if there is a choice
  // Orientations nearer to the pole than this count as the pole: the tool axis may be off by as much.
  double pole_tolerance = 1e-7;  // rad
  // Between two neighbouring poses a rotary axis turns at most this far unless an unwinding lies between.
  double largest_step = 3.2;  // rad
};

struct PlannedPose {
  AxisPositions axes{};
  bool unwind = false;    // lift off, turn the rotary axes, come back: before this pose
  bool singular = false;  // the tool axis is at the pole; the first rotary axis was free
};

[[nodiscard]] Result<std::vector<PlannedPose>> plan_axes(const Machine& machine,
                                                         std::span<const ToolPose> path,
                                                         double tool_length,
                                                         const PlanOptions& options);

}  // namespace frustum::kinematics
