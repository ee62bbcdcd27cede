// The charts of a result as one SVG that opens by itself: polar charts of forms, profiles of lines.
//
// Model  : the drawings of the page, one below the other, each with its name
// Units  : those of the charts: µm, mm, degrees
// Errors : none; a result without charts gives a drawing that says so
#pragma once

#include <string>

#include "report/run_report.hpp"

namespace frustum::report {

[[nodiscard]] std::string charts_svg(const RunReport& report);

}  // namespace frustum::report
