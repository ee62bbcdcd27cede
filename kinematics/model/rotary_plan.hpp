// Which of its axis solutions a five-axis path takes at each pose.
//
// Model    : every pose has a few solutions (two orientations, each shifted by full turns within
//            travel); the plan is the cheapest way through them: fewest unwindings, then the start
//            nearest to the preferred one, then least rotary travel, where travel of the first
//            rotary axis near the pole weighs more. Poses at the pole leave that axis free: it goes
//            evenly from its position at the pose before to that at the pose after, so that a path
//            through the pole changes the sign of the tilt axis instead of spinning the table (the
//            alpha = beta rule). Where no way stays within travel it unwinds with the tool
//            retracted.
// Units    : mm, rad; frame: table
// Shape    : time and memory linear in the number of poses
// Errors   : a pose that no solution reaches within travel, with its index and the axis that is in
//            the way; a step between two poses that no solution makes
// Source   : dynamic programming over the solutions; pole rule: ETH thesis on a five-axis test
//            piece
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/model/tool_pose.hpp"

namespace frustum::kinematics {

struct PlanOptions {
  AxisPositions start{};                     // where the axes are before the first pose
  std::optional<AxisPositions> preferred{};  // rotary positions to begin near, if there is a choice
  // Orientations nearer to the pole than this count as the pole: the tool axis may be off by as
  // much.
  double pole_tolerance = 1e-7;  // rad
  // Between two neighbouring poses a rotary axis turns at most this far unless an unwinding is
  // between.
  double largest_step = 3.2;  // rad
  // Nearer to the pole than this the first rotary axis's travel counts `singular_weight` times.
  double singular_cone = 1.0 * kRadPerDeg;
  double singular_weight = 3.0;
  // Poses (increasing indices) that the tool comes to through the air: the rotary axes may turn as
  // they like before them, and nothing need be unwound. The first pose always is one.
  std::vector<std::size_t> through_air{};
};

struct PlannedPose {
  AxisPositions axes{};
  // Before this pose: lift off where the last pose is, turn to `resume` (the same pose on other
  // axis positions), come back, and go on from there.
  bool unwind = false;
  AxisPositions resume{};
  bool singular = false;  // the tool axis is at the pole; the first rotary axis was free
};

[[nodiscard]] Result<std::vector<PlannedPose>> plan_axes(const Machine& machine,
                                                         std::span<const ToolPose> path,
                                                         double tool_length,
                                                         const PlanOptions& options);

}  // namespace frustum::kinematics
