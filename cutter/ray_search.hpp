// What the sweeps of one tool cover of a ray, found from coarse groups of poses to single stretches.
//
// Model    : groups that cover nothing beyond what is covered already, by their own bounds or by a plane at
//            an end of the cover, are left aside; of the others the witness, standing still, adds what it
//            covers, and the halves are asked, what promises most first, down to the stretches themselves
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : ends within twice kSearchTolerance normal to the swept surface, for the solution and for what
//            is left aside, and within what the stretches themselves allow (SweptCutter::accuracy)
// Source   : ours
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cutter/body.hpp"
#include "cutter/pose_tree.hpp"
#include "cutter/stretch_sweep.hpp"
#include "kinematics/tool_path.hpp"

namespace frustum::cutter {

// The sweeps of one tool.
struct ToolSweep {
  const Body* body = nullptr;
  PoseTree tree;
};

// An end of what is covered: where, by which stretch, and when.
struct CoverEnd {
  double s = 0.0;
  std::uint32_t stretch = 0;
  std::uint32_t slab = 0;  // of the body, or kInAHollow
  double t = 0.0;
  ProfileFace face = kTopFace;
};
struct CoverInterval {
  CoverEnd lo{};
  CoverEnd hi{};
};

// A ray and which stretches count: those before `first_excluded`.
struct RayQuestion {
  const kinematics::ToolPath* path = nullptr;
  Ray ray{};
  RaySpan span{};
  std::uint32_t first_excluded = 0;
};

// Everything covered within the span: disjoint, ascending. Intervals may reach beyond the span; an end
// beyond it is a bound, not an end of the cover. `cover` is what other tools cover already.
void extend_cover(const RayQuestion& question, const ToolSweep& sweep,
                  std::vector<CoverInterval>& cover);

// Moves `front` up to the end of what covers it without a gap; false if nothing does. Gaps of less than
// `gap` are passed over.
bool advance_front(const RayQuestion& question, const ToolSweep& sweep, double gap,
                   CoverEnd& front);

}  // namespace frustum::cutter
