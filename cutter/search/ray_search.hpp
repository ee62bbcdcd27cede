// What the sweeps of one tool cover of a ray, found from coarse groups of poses to single segments.
//
// Model    : groups that cover nothing beyond what is covered already, by their own bounds or by a
//            plane at an end of a swept interval, are left aside; of the others the representative
//            adds what it covers, and the halves are asked, what promises most first, down to the
//            segments themselves
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : ends within twice kSearchTolerance normal to the swept surface, for the solution and
//            for what is left aside, and within what the segments themselves allow
//            (SweptCutter::accuracy)
// Source   : ours
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cutter/body/body.hpp"
#include "cutter/search/pose_tree.hpp"
#include "cutter/sweep/segment_sweep.hpp"
#include "kinematics/path/tool_path.hpp"

namespace frustum::cutter {

// The sweeps of one tool.
struct ToolSweep {
  const Body* body = nullptr;
  PoseTree tree;
};

// An end of what is covered: where, by which segment, and when.
struct SweptIntervalEnd {
  double s = 0.0;
  std::uint32_t segment = 0;
  std::uint32_t section = 0;  // of the body, or kConcaveSurface
  double t = 0.0;
  ProfileFace face = kTopFace;
};
struct SweptInterval {
  SweptIntervalEnd lo{};
  SweptIntervalEnd hi{};
};

// A ray and which segments count: those before `first_excluded`.
struct RayQuestion {
  const kinematics::ToolPath* path = nullptr;
  Ray ray{};
  RaySpan span{};
  std::uint32_t first_excluded = 0;
};

// Everything covered within the span: disjoint, ascending. Intervals may reach beyond the span; an
// end beyond it is a bound, not an end of a swept interval. `swept` is what other tools cover
// already.
void extend_swept_interval(const RayQuestion& question, const ToolSweep& sweep,
                           std::vector<SweptInterval>& swept);

}  // namespace frustum::cutter
