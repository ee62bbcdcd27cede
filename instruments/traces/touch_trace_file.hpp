// Touches of a calibration of A and C as a machine reports them.
//
// Text   : columns A_deg, C_deg, point, x_mm, y_mm, z_mm (trace_table.hpp), rows in any order:
//          positions of the axes, point of touch_plan.hpp, and the touched point, the radius of the
//          ball taken off; or ball_x_mm, ball_y_mm, ball_z_mm, the centre of the ball
//          (A, C, POINT, BALLX, BALLY, BALLZ as DPRNT writes them)
// Units  : as the columns say; x, y, z in machine coordinates from the crossing of the axes A and C
// Shape  : out: a reading a touch of the plan, mm outward along its nominal normal; what lies
//          across the normal is not looked at
// Errors : a touch that the plan has not, one twice or missing, one beyond 10 mm of its nominal
//          place (a wrong unit or origin): with file and line
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "instruments/touch_plan.hpp"

namespace frustum::instruments {

[[nodiscard]] Result<std::vector<double>> read_touches(const std::filesystem::path& file,
                                                       const TouchPlan& plan, double ball_radius);
// Such a file of readings.
[[nodiscard]] std::string touch_csv(const TouchPlan& plan, const std::vector<double>& readings);

}  // namespace frustum::instruments
