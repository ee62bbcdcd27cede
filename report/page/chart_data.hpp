// What the page's script draws: polar charts, profiles of lines, axis charts and the coloured
// surface, as JSON.
//
// Units: rad and um in polar charts, mm, um and urad in profiles, mm and deg in axis charts, um for
// the colour scale; the surface is quantised (see chart_data.cpp) and packed (packed_array.hpp).
// Errors: none; numbers that are not finite become null, an inconsistent surface is left out.
#pragma once

#include <string>

#include "report/run_report.hpp"

namespace frustum::report {

// True when the characteristic has the deviations for a polar chart.
[[nodiscard]] bool has_polar_chart(const metrology::CharacteristicResult& characteristic);
// True when it compares lines and has a chart of their points: every distance, and the angles of
// lines whose distance is not asked for.
[[nodiscard]] bool has_profile_chart(const RunReport& report,
                                     const metrology::CharacteristicResult& characteristic);
// True when there is a surface to show.
[[nodiscard]] bool has_surface(const RunReport& report);

// {"polar":[..],"profiles":[..],"traces":[..],"surface":{..}|null}: charts in the order of the
// report's characteristics that have one, and of its traces.
[[nodiscard]] std::string chart_data(const RunReport& report);

}  // namespace frustum::report
