// The measured points as CSV: what `frustum measure --points` reads back.
//
// Columns: feature,section,x,y,z. Units: mm in the datum frame, 17 significant digits.
// Errors: none; points with a coordinate that is not finite are left out.
#pragma once

#include <string>

#include "metrology/measurement.hpp"

namespace frustum::report {

[[nodiscard]] std::string points_csv(const metrology::Measurement& measurement);

}  // namespace frustum::report
