#include "dynamics/response.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/general_algebra.hpp"
#include "core/golden_section.hpp"
#include "core/linear_algebra.hpp"
#include "dynamics/inertial_load.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

}  // namespace

Vec3 StaticResponse::stiffness() const { return compliance.diagonal().cwiseInverse(); }

Vec3 StaticResponse::held_stiffness() const { return compliance.inverse().diagonal(); }

StaticResponse static_response(const DynamicModel& model, const Structure& structure) {
  const MatrixXd tip = structure.tip_displacement();
  const auto axes = static_cast<Index>(model.axes.size());
  MatrixXd loads(structure.coordinates(), 4 + axes);
  loads.leftCols(3) = tip.transpose();
  loads.col(3) = weight(structure);
  loads.rightCols(axes) = unit_acceleration_loads(model, structure);
  const MatrixXd answer = tip * SymmetricFactors(structure.stiffness).solve(loads);
  return {Mat3(answer.leftCols(3)), answer.rightCols(axes), answer.col(3)};
}

HarmonicSystem harmonic_system(const Structure& structure, double frequency) {
  const double w = kTurn * frequency;
  HarmonicSystem system{MatrixXcd(structure.coordinates(), structure.coordinates()),
                        structure.tip_displacement()};
  system.dynamic_stiffness.real() = structure.stiffness - w * w * structure.mass;
  system.dynamic_stiffness.imag() = w * structure.damping;
  return system;
}

Eigen::Matrix3Xcd tip_response(const HarmonicSystem& system, const MatrixXcd& loads) {
  return system.tip * complex_solution(system.dynamic_stiffness, loads);
}

Eigen::Matrix3cd tip_compliance(const HarmonicSystem& system) {
  return tip_response(system, system.tip.transpose());
}

std::complex<double> factor_of(Quantity quantity, double frequency) {
  const std::complex<double> derivative(0.0, kTurn * frequency);
  switch (quantity) {
    case Quantity::compliance:
      break;
    case Quantity::mobility:
      return derivative;
    case Quantity::accelerance:
      return derivative * derivative;
  }
  return 1.0;
}

std::vector<Peak> dominant_peaks(const Structure& structure, double highest) {
  const auto compliance = [&](double frequency) {
    return Vec3(tip_compliance(harmonic_system(structure, frequency)).diagonal().cwiseAbs());
  };
  std::vector<Vec3> looks;  // at 0, 1, 2 .. Hz
  for (int f = 0; f <= static_cast<int>(highest); ++f) looks.push_back(compliance(f));
  std::vector<Peak> peaks;
  for (Index i = 0; i < 3; ++i) {
    const auto first = static_cast<std::ptrdiff_t>(peaks.size());
    for (std::size_t f = 1; f + 1 < looks.size(); ++f) {
      if (!(looks[f][i] > looks[f - 1][i] && looks[f][i] >= looks[f + 1][i])) continue;
      const auto at = static_cast<double>(f);
      constexpr double kNarrow = 1e-6;  // Hz: a smooth top is not known better
      const GoldenBracket top =
          golden_section([&](double x) { return -compliance(x)[i]; }, at - 1.0, at + 1.0, kNarrow);
      peaks.push_back({i, top.at, -top.value});
    }
    std::sort(peaks.begin() + first, peaks.end(),
              [](const Peak& a, const Peak& b) { return a.compliance > b.compliance; });
  }
  return peaks;
}

}  // namespace frustum::dynamics
