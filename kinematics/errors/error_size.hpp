// How large the errors of a machine become where a program takes its axes.
//
// Model    : each component error at the places (ends of blocks) in both directions of approach,
//            and at 1,001 more over the range of its axis; location errors as they are
// Units    : mm, rad
// Errors   : above 1 mm or 10 mrad a warning, above 10 mm or 0.1 rad, or no number at all, an
//            error, each with the place where it is largest; no machine is that bad, and small
//            rotations are small no longer
#pragma once

#include <span>

#include "core/diagnostic.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

[[nodiscard]] Diagnostics oversize_errors(const Machine& machine, const GeometricErrors& errors,
                                          std::span<const AxisPositions> places);

}  // namespace frustum::kinematics
