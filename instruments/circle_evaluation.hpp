// The values of a circular test: G, F and D of ISO 230-4.
//
// Model    : about the circle of least squares of each run: G its range, F its extremes from the
//            nominal radius about the fitted centre; G of the minimum zone besides. Both runs
//            together about one circle: G_bi. D: radius of that circle less the nominal one, which
//            a calibrated bar shows
// Units    : mm
// Shape    : one or two runs
// Errors   : those of polar_fit.hpp
// Accuracy : 1e-10 mm; on full circles D is the mean of all deviations
// Source   : ISO 230-4, by its name
#pragma once

#include <optional>
#include <span>

#include "core/result.hpp"
#include "instruments/polar_fit.hpp"
#include "instruments/signature.hpp"

namespace frustum::instruments {

struct RunValues {
  Sense sense = Sense::ccw;
  PolarCircle circle{};
  double g_least_squares = 0.0;
  double g_minimum_zone = 0.0;
  double f_max = 0.0, f_min = 0.0;
};

struct CircleValues {
  std::optional<RunValues> ccw{}, cw{};
  PolarCircle both{};
  double g_bi_least_squares = 0.0;
  double g_bi_minimum_zone = 0.0;
  double d_mean_radial = 0.0;
};

// Minimum zones take most of the time: whoever asks for none has 0 in their place.
enum class MinimumZones { evaluated, left_out };
[[nodiscard]] Result<CircleValues> circle_values(std::span<const CircleTrace> traces,
                                                 MinimumZones zones = MinimumZones::evaluated);

}  // namespace frustum::instruments
