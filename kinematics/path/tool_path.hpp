// Where the tool really is: poses in the workpiece frame, close enough together.
//
// Between neighbouring poses of a segment the tip moves on a straight line and the axis on a great
// circle (slerp), both uniform; that is within `bound` (default 0.01 um, measured at the tip and at
// the upper end of the cutter) of the true motion.
// Units: mm; frame: workpiece. The axis is the unit vector from the tip to the spindle.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinematics/controller/path_kind.hpp"
#include "kinematics/model/axes.hpp"
#include "kinematics/model/tool_pose.hpp"

namespace frustum::kinematics {

// One NC block's motion: what is common to all its segments.
struct PathBlock {
  std::uint32_t source_line = 0;
  // Of a subprogram that has a file of its own; null: the file of the main program.
  std::shared_ptr<const std::string> source_file{};
  std::uint32_t main_line = 0;  // of the main program: this line, or the call that led to it
  PathKind kind = PathKind::feed;
  SpindleDirection spindle = SpindleDirection::clockwise;  // off: it is at rest
  int tool = 0;                                            // tool number in the spindle
  double feed = 0.0;  // mm/min (deg/min where only rotary axes move) as programmed; 0: rapid
  double feed_duration = 0.0;              // s, at the programmed feed; 0 for rapids
  double duration = 0.0;                   // s, by the time law
  std::optional<AxisLetter> limited_by{};  // the axis whose limit slowed the block below its feed

  [[nodiscard]] bool spindle_on() const { return spindle != SpindleDirection::off; }
};

// From poses[first_pose] to poses[first_pose + 1].
struct PathSegment {
  std::uint32_t first_pose = 0;
  std::uint32_t block = 0;
};

struct ToolPath {
  std::vector<ToolPose> poses{};
  std::vector<AxisState>
      axes{};                   // commanded at each pose; empty when the path comes from elsewhere
  std::vector<double> times{};  // s since the start of the program at each pose, by the time law
  std::vector<AxisPositions>
      velocities{};  // mm/s, rad/s of the commanded axes as they come to each pose
  // Of the way through its block at each pose, 0 to 1; empty when the path comes from elsewhere.
  std::vector<double> shares{};
  std::vector<PathSegment> segments{};  // in program order
  std::vector<PathBlock> blocks{};
  double bound = 1e-5;  // mm: the chord bound that the sampling kept

  [[nodiscard]] const ToolPose& from(const PathSegment& s) const { return poses[s.first_pose]; }
  [[nodiscard]] const ToolPose& to(const PathSegment& s) const { return poses[s.first_pose + 1]; }
};

}  // namespace frustum::kinematics
