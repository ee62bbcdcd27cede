// Boxes around what a moving body of revolution covers.
//
// Units    : mm; frame: workpiece
// Errors   : none
// Accuracy : they hold all of it but for rounding (1e-12 mm)
#pragma once

#include "core/box.hpp"
#include "cutter/sweep/segment_motion.hpp"

namespace frustum::cutter {

// What a body is within: heights along its axis above the tip, and its largest radius.
struct AxialExtent {
  double bottom = 0.0, top = 0.0;
  double radius = 0.0;
};

[[nodiscard]] Box swept_box(const AxialExtent& extent, const SegmentMotion& motion);

}  // namespace frustum::cutter
