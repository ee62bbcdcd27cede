// The touches of a calibration as a program (probing_program.hpp).
//
// Model    : A and C are indexed well above the columns; the ball goes as far beyond a surface as
//            it began before it. G54 is where the axes A and C cross
// Text     : what is logged is what traces/touch_trace_file.hpp reads
// Units    : mm, rad
// Errors   : none; reach is that of touch_test.hpp
#pragma once

#include "instruments/probing_program.hpp"
#include "instruments/touch_plan.hpp"
#include "instruments/touch_test.hpp"

namespace frustum::instruments {

[[nodiscard]] ProbingProgram touch_program(const TouchPlan& plan, const TouchProbe& probe);

}  // namespace frustum::instruments
