// The waves that a closed profile is made of: undulations per revolution.
//
// Model    : deviation = mean + sum over k = 1 .. highest of amplitude_k cos(k angle - phase_k),
//            least squares
// Units    : rad; amplitudes in the unit of the deviations
// Shape    : n >= 2 highest + 1 samples at any angles
// Errors   : too few samples; angles that do not tell the waves apart (an arc)
// Accuracy : rounding times the condition of the angles, which is 1 for equal steps
// Source   : ISO 12181-1 (undulations per revolution)
#pragma once

#include <span>
#include <vector>

#include "core/result.hpp"
#include "metrology/measurement.hpp"

namespace frustum::metrology {

[[nodiscard]] Result<std::vector<Harmonic>> harmonics(std::span<const double> angle,
                                                      std::span<const double> deviation,
                                                      int highest);

}  // namespace frustum::metrology
