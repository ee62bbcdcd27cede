#include "post/nearest_plan.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/block_motion.hpp"
#include "kinematics/inverse.hpp"

namespace frustum::post {

using kinematics::AxisPositions;
using kinematics::PlannedPose;

Result<std::vector<PlannedPose>> nearest_plan(const kinematics::Machine& machine,
                                              std::span<const kinematics::ToolPose> path,
                                              double tool_length,
                                              const kinematics::PlanOptions& options) {
  std::vector<PlannedPose> plan;
  AxisPositions previous = options.start;
  for (const kinematics::ToolPose& pose : path) {
    const auto solutions = kinematics::inverse(machine, pose, tool_length, previous);
    if (!solutions) return solutions.error();
    PlannedPose next{.axes = solutions->front().axes, .singular = solutions->front().singular};
    for (const kinematics::AxisLetter letter : kinematics::kRotaryAxes) {
      const double step = std::abs(next.axes[letter] - previous[letter]);
      next.unwind = next.unwind || step > options.largest_step;
    }
    plan.push_back(next);
    previous = next.axes;
  }
  return plan;
}

}  // namespace frustum::post
