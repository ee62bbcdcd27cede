// Where the axes are during an operation: linear axes on the left scale, rotary axes, dashed, on
// the right.
//
// Units: mm and deg. Errors: none; values that are not finite are left out.
#pragma once

#include <string>

#include "report/run_report.hpp"
#include "report/wording.hpp"

namespace frustum::report {

// A <figure>.
[[nodiscard]] std::string axis_figure(const AxisTrace& trace, const Wording& words = Wording());

}  // namespace frustum::report
