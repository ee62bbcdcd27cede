#include "dynamics/harmonic_circle.hpp"

#include <cmath>

#include "core/constants.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::Vector2cd;
using Eigen::Vector2d;

}  // namespace

HarmonicCircle harmonic_circle(const ServoSystem& system, const Structure& structure,
                               std::size_t first, std::size_t second, double radius, double speed) {
  HarmonicCircle circle{.omega = speed / radius};
  const Eigen::Matrix3Xcd per_command = tracking_deviation(system, circle.omega / kTurn);
  const std::array axes{first, second};
  // q = Re(amplitude e^iwt): R cos wt, R sin wt.
  const std::array<std::complex<double>, 2> commands{radius, std::complex<double>(0.0, -radius)};
  Eigen::Matrix<double, 2, 3> plane;
  for (Eigen::Index i = 0; i < 2; ++i) {
    plane.row(i) = structure.joints[axes[static_cast<std::size_t>(i)]].direction.transpose();
  }
  Vector2cd sum(commands[0], commands[1]);
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector2cd deviation = plane.cast<std::complex<double>>() *
                                per_command.col(static_cast<Eigen::Index>(axes[k])) * commands[k];
    circle.phasors[0][k] = deviation[0];
    circle.phasors[1][k] = deviation[1];
    sum += deviation;
  }
  // Re(z e^iwt) = Re z cos wt - Im z sin wt.
  const Vector2d a = sum.real(), b = -sum.imag();
  // Semi-axes of the ellipse, from the half sum and difference of the two circles in it.
  const double with = 0.5 * std::hypot(a.x() + b.y(), a.y() - b.x());
  const double against = 0.5 * std::hypot(a.x() - b.y(), a.y() + b.x());
  circle.roundness = 2.0 * std::min(with, against);
  constexpr int kPoints = 3600;  // an even mean of a periodic function: exact but for rounding
  for (int i = 0; i < kPoints; ++i) {
    const double t = kTurn * i / kPoints;
    circle.mean_radial += (std::cos(t) * a + std::sin(t) * b).norm() - radius;
  }
  circle.mean_radial /= kPoints;
  return circle;
}

}  // namespace frustum::dynamics
