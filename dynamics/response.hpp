// What forces and accelerations move the tip by, at rest and at a frequency.
//
// Model    : compliance G = L (K + i w D - w^2 M)^-1 L^T: a force on the tool, its reaction on the
//            workpiece; mobility i w G, accelerance -w^2 G. Inertial compliance H = L (..)^-1 f for
//            the load f of a unit acceleration of each axis. At rest w = 0. Measured stiffness is
//            1 / G_ii; the diagonal of G^-1 is that of a tip held in the other directions
// Units    : m/N, m per m/s^2, m per rad/s^2; frequencies in Hz
// Shape    : 3 x 3 and 3 x axes, in the frame of the machine
// Errors   : none; K is positive definite (loose_body)
// Accuracy : 1e-8 of the largest entry (tests/dynamics/reference_test.cpp)
// Source   : ETH thesis, sections 6.1 and 6.2
#pragma once

#include <Eigen/Core>
#include <vector>

#include "dynamics/dynamic_model.hpp"
#include "dynamics/structure.hpp"

namespace frustum::dynamics {

struct StaticResponse {
  Mat3 compliance = Mat3::Zero();             // m/N
  Eigen::Matrix3Xd inertial{};                // m per unit acceleration, a column for each axis
  Vec3 sag = Vec3::Zero();                    // m, under the weight of the bodies
  [[nodiscard]] Vec3 stiffness() const;       // N/m, as measured
  [[nodiscard]] Vec3 held_stiffness() const;  // N/m, the diagonal of G^-1
};
[[nodiscard]] StaticResponse static_response(const DynamicModel& model, const Structure& structure);

// Machines that answer a harmonic load: springs, or closed loops.
struct HarmonicSystem {
  Eigen::MatrixXcd dynamic_stiffness{};
  Eigen::MatrixXd tip{};  // 3 rows
};
[[nodiscard]] HarmonicSystem harmonic_system(const Structure& structure, double frequency);

// What loads move the tip by.
[[nodiscard]] Eigen::Matrix3Xcd tip_response(const HarmonicSystem& system,
                                             const Eigen::MatrixXcd& loads);
[[nodiscard]] Eigen::Matrix3cd tip_compliance(const HarmonicSystem& system);

enum class Quantity { compliance, mobility, accelerance };
[[nodiscard]] std::complex<double> factor_of(Quantity quantity, double frequency);

struct Peak {
  Eigen::Index direction = 0;  // of force and motion: x, y, z
  double frequency = 0.0;      // Hz
  double compliance = 0.0;     // m/N
};
// Local maxima of |G_ii|, searched in steps of 1 Hz up to `highest` and refined; by direction, the
// largest first.
[[nodiscard]] std::vector<Peak> dominant_peaks(const Structure& structure, double highest);

}  // namespace frustum::dynamics
