// Points brought to a local frame of size one, in which the fits work without losing digits.
//
// Units  : points in mm; the local frame is (x - centre) / scale. scale is a power of two, so
//          scaling is exact
// Errors : too few points, not finite, all points coincide
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/least_squares.hpp"

namespace frustum::metrology {

struct NormalisedPoints {
  std::vector<Vec3> points{};
  Vec3 centre = Vec3::Zero();
  double scale = 1.0;

  [[nodiscard]] Vec3 back(const Vec3& local) const { return centre + scale * local; }
};

// `what` names the element in diagnostics; `least` is the number of points it needs.
[[nodiscard]] Result<NormalisedPoints> normalise(std::span<const Vec3> points,
                                                 std::string_view what, std::size_t least);

// Standard deviations along the principal directions of the local points, largest first.
struct PrincipalDirections {
  Vec3 spread = Vec3::Zero();
  Mat3 directions = Mat3::Identity();  // columns
};
[[nodiscard]] PrincipalDirections principal_directions(const NormalisedPoints& local);

// Below this ratio of spreads points count as collinear or coplanar: coordinates carry 16 digits,
// so what is left would be rounding.
inline constexpr double kFlat = 1e-11;

// Completes a fit: residuals (local, in the order of the points), form, rms, and cofactor and
// covariance from those of the local frame. `is_angle[i]` tells which parameters do not scale with
// length; `redundancy` is the number of residual components less the number of parameters.
void complete(const NormalisedPoints& local, std::span<const double> local_residuals,
              const Eigen::MatrixXd& local_cofactor, std::span<const bool> is_angle,
              double redundancy, std::vector<double>& residuals, double& form, double& rms,
              Eigen::MatrixXd& cofactor, Eigen::MatrixXd& covariance);

template <typename T>
[[nodiscard]] Fit<T> completed(const NormalisedPoints& local, T element,
                               std::span<const double> local_residuals,
                               const Eigen::MatrixXd& local_cofactor,
                               std::span<const bool> is_angle, double redundancy, int iterations) {
  Fit<T> fit;
  fit.element = std::move(element);
  fit.iterations = iterations;
  complete(local, local_residuals, local_cofactor, is_angle, redundancy, fit.residuals, fit.form,
           fit.rms, fit.cofactor, fit.covariance);
  return fit;
}

// The one of +-axis whose largest component is positive, so that equal data give equal signs.
[[nodiscard]] UnitVec3 canonical(const Vec3& axis);

}  // namespace frustum::metrology
