// The touches of a calibration as a program that a machine runs and logs.
//
// Model    : A and C are indexed well above the columns. For each touch the ball goes over its
//            place of approach, down to it, and feeds along the normal until the probe trips, at
//            most as far beyond the surface as it began before it; back, and up. LinuxCNC G38.2 and
//            LOG; Fanuc G31 and DPRNT; Sinumerik MEAS and WRITE; Klartext TCH PROBE 4 and FN 16
//            with a mask beside the program
// Text     : G54 (datum 1) with its origin where the axes A and C cross, tool 1 with its length to
//            the centre of the ball. What is logged is what traces/touch_trace_file.hpp reads
// Units    : mm, deg, mm/min in the text
// Errors   : none; reach is that of touch_test.hpp
// Source   : programming manuals of the controls; LinuxCNC's and Fanuc's are read by parser/, none
//            was run on a control
#pragma once

#include <string>

#include "instruments/touch_plan.hpp"
#include "instruments/touch_test.hpp"
#include "parser/dialect.hpp"

namespace frustum::instruments {

[[nodiscard]] std::string touch_program(const TouchPlan& plan, const TouchProbe& probe,
                                        parser::Dialect dialect = parser::Dialect::linuxcnc);
// By which FN 16 of the Klartext program writes its lines: touch.a beside it.
[[nodiscard]] std::string touch_mask();

}  // namespace frustum::instruments
