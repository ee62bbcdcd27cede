// A random function of an axis's position, written `field 3um correlation 40mm kernel gaussian`.
//
// Model    : a stationary normal process with the correlation of its kernel, as harmonics on a
//            circle of length P (gaussian: span + 6 l; matern32: 2 span + 8 l), so long that both
//            ends of the span do not know of each other: f(q) = a_0 + sum a_k cos(2 pi k q / P) +
//            b_k sin(2 pi k q / P), a_k and b_k normal with variance S(2 pi k / P) / P, twice that
//            for k > 0, S the spectral density. As many harmonics as have 99.9 % of the variance;
//            these are rescaled to the whole of it
// Units    : lengths mm (or rad of a rotary axis); variances per square of the field's standard
//            deviation
// Errors   : more than kMostHarmonics: the correlation length is too short for the span
// Accuracy : covariance of the truncated field 1.2e-3 of the variance
//            (tests/studies/random_field_test.cpp)
// Source   : spectral representation of stationary processes; kernels: Rasmussen and Williams,
//            Gaussian Processes for Machine Learning, chapter 4
#pragma once

#include <vector>

#include "core/result.hpp"
#include "kinematics/errors/error_shape.hpp"

namespace frustum::studies {

inline constexpr int kMostHarmonics = 1000;

struct FieldSpectrum {
  double period = 0.0;
  std::vector<double> variances{};  // of harmonics 0, 1, ...; before rescaling

  // Factor on all amplitudes that makes the variances sum to 1.
  [[nodiscard]] double rescaling() const;
};
[[nodiscard]] Result<FieldSpectrum> field_spectrum(kinematics::FieldKernel kernel, double span,
                                                   double correlation_length);

// The correlation of the kernel at a distance.
[[nodiscard]] double kernel_value(kinematics::FieldKernel kernel, double distance,
                                  double correlation_length);

// The field of an entry's term as cyclic terms whose normal amounts are named quantities,
// "EYX/0/field/0", "EYX/0/field/1/cos", ...
[[nodiscard]] Result<std::vector<kinematics::ErrorShape>> field_terms(
    const kinematics::ErrorShape& field, const kinematics::AxisRange& span,
    const std::string& place);

}  // namespace frustum::studies
