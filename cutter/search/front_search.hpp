// How far what covers a place of a ray goes on without a gap.
//
// Model    : a front that moves along the ray: to the end of what covers it, as long as anything
//            does. It is led by what is likely there, so that most groups of poses are held back by
//            a plane that is nearly final when they are looked at
// Units    : mm along the ray; frame: workpiece
// Errors   : none
// Accuracy : as ray_search.hpp
// Source   : ours
#pragma once

#include <cstdint>
#include <span>

#include "cutter/search/end_fan.hpp"
#include "cutter/search/ray_search.hpp"

namespace frustum::cutter {

// Moves `front` up to the end of what covers it without a gap; false if nothing does. Gaps of less
// than `gap` are passed over. Begun with what is likely at the front; ends that differ by rounding
// may depend on that, and so on segments that cover nothing of the ray.
bool advance_front(const RayQuestion& question, const ToolSweep& sweep, double gap,
                   SweptIntervalEnd& front);
// The same where nothing else counts than `groups`, begun with the segments in `first` alone.
// `fans`: of these groups at ends near by, or null; those that are missing are added.
bool advance_front(const RayQuestion& question, const ToolSweep& sweep, double gap,
                   std::span<const std::uint32_t> groups, std::span<const std::uint32_t> first,
                   EndFans* fans, SweptIntervalEnd& front);

}  // namespace frustum::cutter
