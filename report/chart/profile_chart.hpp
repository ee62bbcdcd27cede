// Two lines as measured: error across over the position along, with their least-squares straight
// lines.
//
// Units: mm in, mm along and um across on the chart. Errors: none; points that are not finite are
// left out.
#pragma once

#include <string>

#include "report/run_report.hpp"
#include "report/wording.hpp"

namespace frustum::report {

// For line_distance; a line_angle shares the profiles of its distance, unless there is none.
[[nodiscard]] bool has_profile_chart(const RunReport& report,
                                     const metrology::CharacteristicResult& characteristic);
// A <figure>.
[[nodiscard]] std::string profile_figure(const metrology::CharacteristicResult& characteristic,
                                         const Wording& words = Wording());

}  // namespace frustum::report
