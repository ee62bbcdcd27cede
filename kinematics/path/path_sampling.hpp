// Adaptive sampling of a continuous tool motion to the ToolPath bound.
//
// Model    : the motion is halved until straight line + great circle between neighbours stays within
//            `bound` of it at the tip and at `reach` above the tip, checked at the quarter points
// Units    : mm
// Accuracy : tests/kinematics/path_sampling_test.cpp holds the bound at a thousand points a block
#pragma once

#include <functional>
#include <vector>

#include "kinematics/path/tool_path.hpp"

namespace frustum::kinematics {

struct SamplingOptions {
  double bound = 1e-5;  // mm
  double reach = 50.0;  // mm: height of the cutter above the tip, where an axis error weighs most
  int least_parts = 1;  // the motion is cut into this many equal parts first
};

struct PathSample {
  double u = 0.0;
  ToolPose pose{};  // motion(u)
};

// Samples of motion(u), u in (0, 1]; motion(0) is `from` and is left out.
[[nodiscard]] std::vector<PathSample> sample_motion(const std::function<ToolPose(double)>& motion,
                                                    const ToolPose& from,
                                                    const SamplingOptions& options);

}  // namespace frustum::kinematics
