#include "post/planning/path_tolerance.hpp"

#include <algorithm>
#include <cmath>

#include "kinematics/model/chain.hpp"

namespace frustum::post {

bool keeps_to_path(const PlanState& state, const BlockPart& part,
                   const kinematics::AxisPositions& end, int depth) {
  // Eighths of a whole block, quarters of its parts, and never so few that turns hide between.
  const double least = part.motion.least_parts() * (part.to - part.from);
  const int parts = std::max(depth == 0 ? 8 : 4, static_cast<int>(std::ceil(least)));
  const bool tip_output = state.tip_output();
  const double length = state.length();
  const Vec3 tip_from = state.controller.tip_at(state.q), tip_to = state.controller.tip_at(end);
  for (int i = 1; i < parts; ++i) {
    const double s = static_cast<double>(i) / parts;
    const Pose programmed = kinematics::nominal_pose(
        state.machine, part.motion.at(part.from + s * (part.to - part.from)), length);
    const Pose reached =
        kinematics::nominal_pose(state.machine, kinematics::part_way(state.q, end, s), length);
    const Vec3 tip = tip_output ? Vec3(tip_from + s * (tip_to - tip_from)) : reached.translation;
    if ((tip - programmed.translation).norm() > state.options.tolerance.value) return false;
    const double turn = angle_between(programmed.rotation.col(2), reached.rotation.col(2));
    if (turn > state.options.angle_tolerance.value) return false;
  }
  return true;
}

}  // namespace frustum::post
