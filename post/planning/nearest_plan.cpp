#include "post/planning/nearest_plan.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/controller/block_motion.hpp"
#include "kinematics/model/inverse.hpp"

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
    double step = 0.0;
    for (const kinematics::AxisLetter letter : kinematics::kRotaryAxes) {
      step = std::max(step, std::abs(next.axes[letter] - previous[letter]));
    }
    const bool air =
        std::binary_search(options.through_air.begin(), options.through_air.end(), plan.size());
    if (step > options.largest_step && !plan.empty() && !air) {
      const auto back = kinematics::inverse(machine, path[plan.size() - 1], tool_length, next.axes);
      if (!back) return back.error();
      next.unwind = true;
      next.resume = back->front().axes;
    }
    plan.push_back(next);
    previous = next.axes;
  }
  return plan;
}

}  // namespace frustum::post
