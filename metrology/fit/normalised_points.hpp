// Points brought to a local frame of size one, in which the fits work without losing digits.
//
// Units  : points in mm; the local frame is (x - centre) / scale. scale is a power of two, so
//          scaling is exact
// Errors : too few points, not finite, all points coincide; weights that are none; constraints that
//          the kind lacks
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "metrology/fit/least_squares.hpp"

namespace frustum::metrology {

struct NormalisedPoints {
  std::vector<Vec3> points{};
  std::vector<double> weights{};  // of the largest; empty: all 1
  double largest_weight = 1.0;
  Constraints constraints{};  // in the local frame, as is
  std::optional<Element> expected{};
  Vec3 centre = Vec3::Zero();
  double scale = 1.0;

  [[nodiscard]] Vec3 back(const Vec3& local) const { return centre + scale * local; }
  [[nodiscard]] double weight(std::size_t i) const { return weights.empty() ? 1.0 : weights[i]; }
  [[nodiscard]] double all_weights() const;
  // Points that weigh anything.
  [[nodiscard]] std::size_t count() const;
};

// `what` names the element in diagnostics; it needs `parameters` equations less what the
// constraints fix, and a point gives `per_point` of them.
struct Needed {
  ElementKind kind;
  std::string_view what;
  std::size_t parameters;
  std::size_t per_point = 1;
};
[[nodiscard]] Result<NormalisedPoints> normalise(std::span<const Vec3> points, const Needed& needed,
                                                 const FitOptions& options);

// About `most` of the points that weigh, spread over the whole sequence without a common stride.
[[nodiscard]] NormalisedPoints thinned(const NormalisedPoints& local, std::size_t most);

// Largest to smallest singular value of the Jacobian behind normal equations, its columns scaled to
// length one.
[[nodiscard]] double condition_of(const Eigen::MatrixXd& normal_equations);

// Standard deviations along the principal directions of the local points, largest first.
struct PrincipalDirections {
  Vec3 spread = Vec3::Zero();
  Mat3 directions = Mat3::Identity();  // columns
};
[[nodiscard]] PrincipalDirections principal_directions(const NormalisedPoints& local);

// Below this ratio of spreads points count as collinear or coplanar: coordinates carry 16 digits,
// so what is left would be rounding.
inline constexpr double kFlat = 1e-11;

// What a solution in the local frame makes a fit of. `is_angle[i]` tells which parameters do not
// scale with length; `redundancy` is the number of residual components that weigh less that of the
// free parameters.
struct LocalSolution {
  std::span<const double> residuals{};  // in the order of the points
  const Eigen::MatrixXd& cofactor;
  std::span<const bool> is_angle{};
  double redundancy = 0.0;
  int iterations = 0;
  double condition = 1.0;
};
struct Quality {
  std::vector<double> residuals{};
  double form = 0.0;
  double rms = 0.0;
  Eigen::MatrixXd cofactor{};
  Eigen::MatrixXd covariance{};
};
[[nodiscard]] Quality quality_of(const NormalisedPoints& local, const LocalSolution& solution);

template <typename T>
[[nodiscard]] Fit<T> completed(const NormalisedPoints& local, T element,
                               const LocalSolution& solution) {
  Quality quality = quality_of(local, solution);
  return {std::move(element),
          std::move(quality.residuals),
          quality.form,
          quality.rms,
          std::move(quality.cofactor),
          std::move(quality.covariance),
          solution.iterations,
          solution.condition};
}

// The one of +-axis whose largest component is positive, so that equal data give equal signs.
[[nodiscard]] UnitVec3 canonical(const Vec3& axis);

}  // namespace frustum::metrology
