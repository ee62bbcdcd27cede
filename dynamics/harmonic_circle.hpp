// A circle of two linear axes in its harmonic steady state, and what the tip makes of it.
//
// Model    : q1 = R cos wt, q2 = R sin wt; the deviations are harmonic too, so that the points are
//            an ellipse about the centre. Its semi-axes are the singular values of [A B] in
//            p = A cos wt + B sin wt; a least-squares circle has the same centre. Radii are those
//            of the points: a lag that is projected on the commanded radius counts twice
// Units    : m, rad/s
// Shape    : two linear axes; x and y of the plane are their directions
// Errors   : none
// Accuracy : 1e-6 (tests/dynamics/servo_test.cpp)
// Source   : ISO 230-4 circular deviations
#pragma once

#include <array>

#include "dynamics/servo.hpp"

namespace frustum::dynamics {

struct HarmonicCircle {
  double omega = 0.0;
  double mean_radial = 0.0;  // m: mean radius of the points less R
  double roundness = 0.0;    // m, about the least-squares circle
  // Deviations along x, and along y of the plane: for the command of the first, the second axis.
  std::array<std::array<std::complex<double>, 2>, 2> phasors{};
};

// `first` and `second` are indices of axes of the model.
[[nodiscard]] HarmonicCircle harmonic_circle(const ServoSystem& system, const Structure& structure,
                                             std::size_t first, std::size_t second, double radius,
                                             double speed);

}  // namespace frustum::dynamics
