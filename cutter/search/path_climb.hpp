// From a segment that makes the end of a ray's neighbour to the one that likely makes its own.
//
// Model    : along the path to the pose whose cutter reaches farthest along the ray, by parabolas
//            through the last three. A guess: what it says is solved and proven by the search
// Units    : mm along the ray; frame: workpiece
// Errors   : none; the segment itself, and `meets` false, where it leads to none that meets the ray
// Source   : ours
#pragma once

#include <cstdint>
#include <optional>

#include "cutter/search/ray_search.hpp"

namespace frustum::cutter {

// About when the cutter reaches farthest.
struct ClimbTop {
  std::uint32_t segment = 0;
  double t = 0.0;
  bool meets = false;  // the ray within its span; of this tool
};
// `leaving`: what is covered is before the end, else after it.
[[nodiscard]] ClimbTop climbed(const RayQuestion& question, const ToolSweep& sweep,
                               std::uint32_t segment, bool leaving);

// The segment that goes on from an end of this one, where the cutter makes an end of what is
// covered at that time; nothing between its poses, or where the path does not run on.
[[nodiscard]] std::optional<std::uint32_t> next_at(const RayQuestion& question,
                                                   const ToolSweep& sweep, std::uint32_t segment,
                                                   double t);

}  // namespace frustum::cutter
