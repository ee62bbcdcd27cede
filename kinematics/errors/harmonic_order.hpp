// Which orders of a harmonic error are read, from words and from tables alike.
//
// Units : waves on the span of the error
// Errors: none
#pragma once

namespace frustum::kinematics {

inline constexpr int kHighestHarmonic = 1000;  // the calibration of an axis has fewer points

}  // namespace frustum::kinematics
