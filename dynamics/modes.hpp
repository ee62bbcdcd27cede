// Natural frequencies, shapes and damping of the machine in one position.
//
// Model    : undamped: K p = (2 pi f)^2 M p with p^T M p = 1, by the Cholesky factor of M and a
//            symmetric solver. Damped: eigenvalues s of [0 1; -M^-1 K, -M^-1 D] in mass-normalised
//            coordinates; f = |s| / 2 pi, ratio = -Re s / |s|
// Units    : Hz, 1/s; shapes 1/sqrt(kg)
// Shape    : as many undamped modes as coordinates, in ascending order
// Errors   : none
// Accuracy : frequencies 1e-8, poles 1e-7 (tests/dynamics/reference_test.cpp)
// Source   : ETH thesis, chapter 6; Golub, Van Loan, Matrix Computations, section 8.7
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/structure.hpp"

namespace frustum::dynamics {

struct UndampedModes {
  Eigen::VectorXd frequencies{};  // Hz
  Eigen::MatrixXd shapes{};       // columns
  Eigen::MatrixXd tip{};          // 3 rows: what each shape moves the tip by
};
[[nodiscard]] UndampedModes undamped_modes(const Structure& structure);
[[nodiscard]] Eigen::VectorXd natural_frequencies(const Structure& structure);  // Hz

// Pairs of complex poles by frequency, and real poles from the slowest on.
struct Poles {
  std::vector<double> frequencies{};  // Hz
  std::vector<double> ratios{};
  std::vector<double> real{};  // 1/s
};
[[nodiscard]] Poles sorted_poles(const Eigen::VectorXcd& values);
[[nodiscard]] Poles damped_modes(const Structure& structure);

// Where a mode is: the body with the most kinetic energy, the connection with the most strain
// energy, and their shares. Bodies and connections are counted from the bed, whose connection is
// the mounts.
struct ModePlace {
  std::size_t body = 0;
  double kinetic_share = 0.0;
  std::size_t connection = 0;
  double strain_share = 0.0;
};
[[nodiscard]] ModePlace place_of_mode(const Structure& structure, const Eigen::VectorXd& shape);

}  // namespace frustum::dynamics
