// What was measured, as a drawing in space: the points of each feature and their sections.
//
// Model  : coordinates of the datum frame; on the layer of a feature its points, on the layer with
//          _SECTION after it one polyline a section, closed where it goes round
// Units  : mm
// Errors : none; points that are not finite are left out
#pragma once

#include <string>

#include "metrology/measurement.hpp"

namespace frustum::report {

[[nodiscard]] std::string sections_dxf(const metrology::Measurement& measurement);

}  // namespace frustum::report
