// Harmonics of a trace over the angle of a rotary axis or around a cone.
//
// Model    : reading = mean + c1 cos + s1 sin + c2 cos2 + s2 sin2, least squares; the form of the
//            trace is its peak to valley without mean, cos and sin, which the set-up makes
// Units    : rad; those of the readings
// Shape    : n >= 5 samples at any angles
// Errors   : too few samples, an arc that does not separate the harmonics
// Accuracy : 1e-12 of the readings on full turns
// Source   : least squares by QR
#pragma once

#include <array>
#include <span>

#include "core/result.hpp"
#include "instruments/polar_fit.hpp"

namespace frustum::instruments {

struct TurnHarmonics {
  std::array<double, 5> value{};  // mean, cos, sin, cos2, sin2
  double residual_rms = 0.0;
  double form = 0.0;  // peak to valley after mean, cos and sin are removed
};

[[nodiscard]] Result<TurnHarmonics> turn_harmonics(const PolarSamples& samples);

}  // namespace frustum::instruments
