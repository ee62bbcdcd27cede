// Poses that tool vectors name one after another, whose axis positions are chosen together.
//
// Units  : mm, rad; frame: table
// Errors : directions out of reach, poses that no solution reaches within travel (rotary_plan.hpp)
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinematics/model/rotary_plan.hpp"
#include "parser/motion.hpp"

namespace frustum::post {

struct PoseRun {
  std::vector<kinematics::ToolPose> poses{};
  std::vector<std::size_t> through_air{};  // rapids, increasing
  bool from_here =
      false;  // the first is cut to from where the tool is, not moved to through the air
};

// The X Y Z words of the target, the point's own where there are none.
[[nodiscard]] Vec3 with_words(Vec3 point, const parser::AxisTarget& words);

// From the first motion to where something else moves the axes. `tip`: where it is, in the words'
// frame.
[[nodiscard]] PoseRun vector_run(std::span<const parser::Motion> motions, Vec3 tip,
                                 const Pose& table_from_words);

enum class AxisChoice : std::uint8_t { along_the_path, nearest };

// One for each pose. From here, a plan that begins on other positions of the tool's present pose
// begins with an unwinding.
[[nodiscard]] Result<std::vector<kinematics::PlannedPose>> choose_axes(
    const kinematics::Machine& machine, const PoseRun& run, const kinematics::AxisPositions& here,
    double tool_length, AxisChoice choice, Rad pole_tolerance);

// Together, as the root of the sum of squares.
[[nodiscard]] double rotary_travel(const kinematics::AxisPositions& from,
                                   const kinematics::AxisPositions& to);

}  // namespace frustum::post
