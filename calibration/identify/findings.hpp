// What an identification reports to its reader besides numbers, as warnings in words.
//
// Units    : texts say um, urad and standard deviations
// Errors   : none
#pragma once

#include "calibration/identify/identification.hpp"

namespace frustum::calibration {

[[nodiscard]] Diagnostics findings(const Observations& observations, const WeightedSystem& system,
                                   const Identification& identification);

}  // namespace frustum::calibration
