// Probabilities that verdicts and intervals need.
//
// Model    : chi-square, Student t and normal distribution
// Units    : none
// Shape    : scalars
// Errors   : none; degrees of freedom are positive, confidence is in (0, 1)
// Accuracy : 1e-12 relative
// Source   : Boost.Math
#pragma once

#include <optional>

namespace frustum::calibration {

// Probability that a right model gives a chi-square of at least this size.
[[nodiscard]] double chi_square_tail(double chi_square, int degrees_of_freedom);

// Half width of the two-sided interval in standard uncertainties: Student t, or normal when the
// standard uncertainty is known without degrees of freedom.
[[nodiscard]] double coverage_factor(double confidence, std::optional<double> degrees_of_freedom);

}  // namespace frustum::calibration
