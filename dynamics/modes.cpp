#include "dynamics/modes.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"
#include "core/general_algebra.hpp"
#include "core/linear_algebra.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A machine that nothing holds has none; rounding may be below zero.
VectorXd frequencies_of(const VectorXd& squares) {
  return squares.cwiseMax(0.0).cwiseSqrt() / kTurn;
}

}  // namespace

UndampedModes undamped_modes(const Structure& structure) {
  const MatrixXd root = mass_root(structure);
  const SymmetricEigen eigen = symmetric_eigen(mass_normalised(root, structure.stiffness));
  UndampedModes modes{frequencies_of(eigen.values), {}, {}};
  modes.shapes = root.transpose().triangularView<Eigen::Upper>().solve(eigen.vectors);
  modes.tip = structure.tip_displacement() * modes.shapes;
  return modes;
}

VectorXd natural_frequencies(const Structure& structure) {
  return frequencies_of(
      symmetric_eigenvalues(mass_normalised(mass_root(structure), structure.stiffness)));
}

Poles sorted_poles(const Eigen::VectorXcd& values) {
  std::vector<std::complex<double>> pairs;
  Poles poles;
  for (const std::complex<double>& s : values) {
    // The solver gives real eigenvalues an imaginary part of exactly zero.
    if (s.imag() > 0.0) pairs.push_back(s);
    if (s.imag() == 0.0) poles.real.push_back(s.real());
  }
  std::ranges::sort(pairs, {}, [](const auto& s) { return std::abs(s); });
  std::ranges::sort(poles.real, std::greater{});
  for (const auto& s : pairs) {
    poles.frequencies.push_back(std::abs(s) / kTurn);
    poles.ratios.push_back(-s.real() / std::abs(s));
  }
  return poles;
}

Poles damped_modes(const Structure& structure) {
  const MatrixXd root = mass_root(structure);
  const MatrixXd k = mass_normalised(root, structure.stiffness);
  // Velocities in units of a frequency of the machine, so that both halves weigh alike.
  const double scale = std::sqrt(k.trace() / static_cast<double>(k.rows()));
  const Index n = k.rows();
  MatrixXd system = MatrixXd::Zero(2 * n, 2 * n);
  system.topRightCorner(n, n) = scale * MatrixXd::Identity(n, n);
  system.bottomLeftCorner(n, n) = -k / scale;
  system.bottomRightCorner(n, n) = -mass_normalised(root, structure.damping);
  return sorted_poles(general_eigen(system, false).values);
}

ModePlace place_of_mode(const Structure& structure, const VectorXd& shape) {
  const std::size_t count = structure.bodies.size();
  std::vector<double> kinetic(count, 0.0), strain(count, 0.0);
  for (std::size_t b = 0; b < count; ++b) {
    const auto at = 6 * static_cast<Index>(b);
    const auto p = shape.segment<6>(at);
    kinetic[b] = p.dot(structure.mass.block<6, 6>(at, at) * p);
  }
  for (const Element& e : structure.elements) {
    const double elongation = e.row.of(shape);
    strain[static_cast<std::size_t>(e.row.outer)] += e.spring.stiffness * elongation * elongation;
  }
  const auto largest = [](const std::vector<double>& energies) {
    double sum = 0.0;
    for (const double energy : energies) sum += energy;
    const auto most = std::ranges::max_element(energies);
    return std::pair{static_cast<std::size_t>(most - energies.begin()),
                     sum > 0.0 ? *most / sum : 0.0};
  };
  const auto [body, kinetic_share] = largest(kinetic);
  const auto [connection, strain_share] = largest(strain);
  return {body, kinetic_share, connection, strain_share};
}

}  // namespace frustum::dynamics
