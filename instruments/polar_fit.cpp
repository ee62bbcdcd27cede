#include "instruments/polar_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/linear_algebra.hpp"
#include "core/pose.hpp"
#include "metrology/fit/minimax/linear_minimax.hpp"

namespace frustum::instruments {
namespace {

std::optional<Diagnostic> too_few(const PolarSamples& samples) {
  if (samples.angle.size() >= 3) return std::nullopt;
  return error("too-few-samples"_id,
               fmt::format("a circle needs three samples, given are {}", samples.angle.size()));
}

}  // namespace

Result<PolarCircle> least_squares_circle(const PolarSamples& samples) {
  if (const auto problem = too_few(samples)) return *problem;
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (std::size_t i = 0; i < samples.angle.size(); ++i) {
    const Vec3 row(1.0, std::cos(samples.angle[i]), std::sin(samples.angle[i]));
    normal += row * row.transpose();
    right += samples.deviation[i] * row;
  }
  const SymmetricFactors factors(normal);
  // 1e-13 of the largest pivot: three samples within a hundredth of a degree.
  const Eigen::VectorXd pivots = factors.pivots();
  if (!(pivots.minCoeff() > 1e-13 * pivots.maxCoeff())) {
    return error("arc-too-short"_id, "the samples are on too short an arc to fit a circle to");
  }
  Vec3 circle = factors.solve(Eigen::VectorXd(right));
  Vec3 left = Vec3::Zero();
  for (std::size_t i = 0; i < samples.angle.size(); ++i) {
    const Vec3 row(1.0, std::cos(samples.angle[i]), std::sin(samples.angle[i]));
    left += (samples.deviation[i] - row.dot(circle)) * row;
  }
  circle +=
      factors.solve(Eigen::VectorXd(left));  // restores the digits that the normal equations lose
  return PolarCircle{circle[0], circle[1], circle[2]};
}

PolarRange range_about(const PolarSamples& samples, const PolarCircle& circle) {
  PolarRange range{std::numeric_limits<double>::infinity(),
                   -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < samples.angle.size(); ++i) {
    const double d =
        samples.deviation[i] - circle.at(std::cos(samples.angle[i]), std::sin(samples.angle[i]));
    range.least = std::min(range.least, d);
    range.most = std::max(range.most, d);
  }
  return range;
}

Result<double> minimum_zone(const PolarSamples& samples) {
  const auto start = least_squares_circle(samples);
  if (!start) return start.error();
  const double scale = range_about(samples, *start).width();
  // Below a picometre deviations are rounding, whose zone is what it is.
  constexpr double kRounding = 1e-9;
  if (scale < kRounding) return scale;
  const auto count = static_cast<Eigen::Index>(samples.angle.size());
  Eigen::VectorXd values(count);
  metrology::Gradients gradients(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double c = std::cos(samples.angle[k]), s = std::sin(samples.angle[k]);
    values[i] = (samples.deviation[k] - start->at(c, s)) / scale;
    gradients.row(i) << -1.0, -c, -s;
  }
  // A quadrant moves the circle by some twenty times the deviations.
  const Eigen::VectorXd reach = Eigen::VectorXd::Constant(3, 1e3);
  const metrology::LinearMinimax found =
      metrology::linear_minimax(values, gradients, metrology::Sides{}, reach);
  if (!found.solved || found.at_bound) {
    return error("not-converged"_id, "no minimum zone was found for the trace",
                 "the arc may be too short: measure more of the circle");
  }
  return 2.0 * found.level * scale;
}

}  // namespace frustum::instruments
