// The touches of a calibration as a program that a machine runs and logs.
//
// Model    : A and C are indexed well above the columns. For each touch the ball goes over its
//            place of approach, down to it, and feeds along the normal until the probe trips
//            (G38.2), at most as far beyond the surface as it began before it; back, and up
// Text     : LinuxCNC, G54 with its origin where the axes A and C cross, tool length to the
//            centre of the ball. Each touch is logged (LOGOPEN, LOG) as touch_trace_file.hpp
//            reads it
// Units    : mm, deg, mm/min in the text
// Errors   : none; reach is that of touch_test.hpp
#pragma once

#include <string>

#include "instruments/touch_plan.hpp"
#include "instruments/touch_test.hpp"

namespace frustum::instruments {

[[nodiscard]] std::string touch_program(const TouchPlan& plan, const TouchProbe& probe);

}  // namespace frustum::instruments
