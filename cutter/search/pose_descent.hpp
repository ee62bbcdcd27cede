// From the root of a tree of poses to a segment whose cutter is likely at a point.
//
// Model    : of four groups the one whose cutter in the middle has its axis nearest to the point,
//            down to a leaf. A guess: whether it is there, and how far it reaches, is for a search
//            to say
// Units    : mm; frame: workpiece
// Errors   : none; nothing where all segments are excluded
// Source   : ours
#pragma once

#include <cstdint>
#include <optional>

#include "cutter/search/ray_search.hpp"

namespace frustum::cutter {

// Of the segments that count.
[[nodiscard]] std::optional<std::uint32_t> likely_segment_at(const Vec3& point,
                                                             const RayQuestion& question,
                                                             const ToolSweep& sweep);

}  // namespace frustum::cutter
