// Two tool paths side by side: where the other one is when the reference passes each of its poses.
//
// Model    : both paths are walked forward together. For each pose of the reference the other path
//            is searched ahead for places that are nearest in (tip, reach * axis) there; it never
//            goes back, so that passes over the same surface stay apart. Where it passes a pose
//            more than once, as at a reversal, each of these places is followed until one is the
//            worse: of all walks that which has the least sum of squared distances is the match
//            Only feed moves count; where they are interrupted, both paths run straight to the next
//            one
// Units    : mm, rad, s; frame: that of the paths
// Errors   : none; a path without feed moves has no matches
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "kinematics/path/tool_path.hpp"

namespace frustum::kinematics {

// A place on a path.
struct PathPlace {
  std::uint32_t block = 0;  // index into ToolPath::blocks
  ToolPose pose{};
  AxisState axes{};   // as commanded; zero when the path has none
  double time = 0.0;  // s of feed motion since the first feed move; 0 when the path has no times
};

struct PathMatch {
  PathPlace reference{};
  PathPlace other{};

  [[nodiscard]] double tip_distance() const { return (reference.pose.tip - other.pose.tip).norm(); }
  [[nodiscard]] double axis_angle() const {
    return angle_between(reference.pose.axis, other.pose.axis);
  }
};

struct PathMatches {
  std::vector<PathMatch> matches{};  // one for each pose of the reference's feed moves
  double left_over = 0.0;            // mm: how far the other path still goes after the last match
};

struct MatchOptions {
  double reach = 20.0;  // mm: what a radian of the tool axis weighs
  // mm: how much further than the reference the other path is searched, and how far beside the
  // reference's way it may go to and fro without that counting.
  double slack = 0.05;
  double most_apart = 5.0;  // mm: paths farther apart are not searched further for that
  // mm: where the paths are farther apart, the walk ends with that match.
  double stop_beyond = std::numeric_limits<double>::infinity();
};

[[nodiscard]] PathMatches match_paths(const ToolPath& reference, const ToolPath& other,
                                      const MatchOptions& options = {});

}  // namespace frustum::kinematics
