// How far a straight pass must run beyond its middle, and how high, to be clear of the blank.
//
// Model    : the tool is a cylinder without end above its tip. At both ends of the pass no material
//            is within `clearance` of it or above it, so that it may go down and up at rapid there.
// Units    : mm; frame: workpiece
// Shape    : `length` centred on the line's middle; a blank of any number of slabs
// Errors   : none; what is not clear within 2 m ends there
// Accuracy : whole mm, rounded up
// Source   : ours
#pragma once

#include "programs/step/step_pattern.hpp"

namespace frustum::programs {

struct StepRun {
  double before = 0.0;  // mm along the feed, from where the pass begins to the middle of the line
  double after = 0.0;   // from there to where it ends
  double clear = 0.0;   // height along the tool axis, over the workpiece origin, above all material
};

[[nodiscard]] StepRun step_run(const StepLine& line, double length, double tool_radius,
                               const stock::LoftShape& blank, const Vec3& blank_origin);

}  // namespace frustum::programs
