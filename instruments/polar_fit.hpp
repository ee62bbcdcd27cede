// Polar traces: the circle about which a trace is evaluated, and the zone that holds it.
//
// Model    : deviation dr(phi) from the nominal circle; a circle of radius R + r0 about (cx, cy) is
//              dr = r0 + cx cos phi + cy sin phi
//            (limacon). Least squares, or the least h with |dr - circle| <= h (minimum zone, 2 h)
// Units    : mm, rad
// Shape    : n >= 3 samples at any angles
// Errors   : too few samples; no minimum zone found
// Accuracy : least squares 1e-12 mm on full circles; minimum zone 1e-12 of the zone. A circle
//            fitted by orthogonal distances differs by less than 1e-6 um at 10 um
// Source   : ISO 230-4; linear minimax by metrology/fit/minimax/linear_minimax.hpp
#pragma once

#include <span>

#include "core/result.hpp"

namespace frustum::instruments {

// Angles and deviations of the same length.
struct PolarSamples {
  std::span<const double> angle{};
  std::span<const double> deviation{};
};

struct PolarCircle {
  double radial = 0.0;  // r0
  double x = 0.0;       // cx, of the first axis of the plane
  double y = 0.0;

  [[nodiscard]] double at(double cosine, double sine) const {
    return radial + x * cosine + y * sine;
  }
};

[[nodiscard]] Result<PolarCircle> least_squares_circle(const PolarSamples& samples);

// Of the deviations from a circle.
struct PolarRange {
  double least = 0.0;
  double most = 0.0;
  [[nodiscard]] double width() const { return most - least; }
};
[[nodiscard]] PolarRange range_about(const PolarSamples& samples, const PolarCircle& circle);

// Width of the minimum zone.
[[nodiscard]] Result<double> minimum_zone(const PolarSamples& samples);

}  // namespace frustum::instruments
