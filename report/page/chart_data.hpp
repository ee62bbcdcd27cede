// What the page's script draws: the coloured surface, as JSON. Charts need no script.
//
// Units: mm, um for the colour scale; the surface is quantised (see chart_data.cpp) and packed
// (packed_array.hpp). Errors: none; an inconsistent surface is left out.
#pragma once

#include <string>

#include "report/run_report.hpp"

namespace frustum::report {

// True when there is a surface to show.
[[nodiscard]] bool has_surface(const RunReport& report);

// {"surface":{..}|null}
[[nodiscard]] std::string chart_data(const RunReport& report);

}  // namespace frustum::report
