// Gaussian filter of measured profiles: what is longer than the cut-off stays.
//
// Model    : weighted mean with weights s(x) = exp(-pi (x / (a c))^2), a = sqrt(ln 2 / pi), each
//            sample counting for the length of profile around it; an undulation of f waves over the
//            length in which the cut-off has one keeps 2^-(f^2) of its amplitude, 0.5 at the
//            cut-off. Closed profiles wrap, and constants stay. Open profiles are smoothed by the
//            weighted straight line around each place, the mean in the middle of the profile; it
//            reaches to the ends, and straight lines stay
// Units    : mm or rad along the profile, deviations in any unit
// Shape    : n samples in any order; not necessarily at equal steps
// Errors   : too few samples for the cut-off: 7 a wave are needed, everywhere: a gap is named with
//            its place; a profile that should be closed and is not; cut-offs that exclude each
//            other
// Accuracy : of equal steps, 2^-((m - 1)^2) of an undulation at the cut-off, m samples a wave:
//            1e-11 at the coarsest; of many points a wave, for which the sums are interpolated,
//            1e-14 of the largest deviation (tests/metrology/profile_filter_test.cpp)
// Source   : ISO 16610-21 (weights), ISO 16610-28 (ends: moments are retained, first order)
#pragma once

#include <span>
#include <vector>

#include "core/result.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::metrology {

// The profile without undulations shorter than `cutoff` (same unit as `place`).
[[nodiscard]] Result<std::vector<double>> open_waviness(std::span<const double> place,
                                                        std::span<const double> deviation,
                                                        double cutoff);
// The same for a closed profile over the angle (rad), cut-off in undulations per revolution.
[[nodiscard]] Result<std::vector<double>> closed_waviness(std::span<const double> angle,
                                                          std::span<const double> deviation,
                                                          double undulations);

// What a plan's filter leaves: upr and upr_from of a closed profile, cutoff and cutoff_long of an
// open one.
[[nodiscard]] Result<std::vector<double>> closed_band(const ProfileFilter& filter,
                                                      std::span<const double> angle,
                                                      std::span<const double> deviation);
[[nodiscard]] Result<std::vector<double>> open_band(const ProfileFilter& filter,
                                                    std::span<const double> place,
                                                    std::span<const double> deviation);

}  // namespace frustum::metrology
