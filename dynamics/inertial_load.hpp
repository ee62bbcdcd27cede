// What the commanded motion asks of the bodies: d'Alembert's load of the nominal machine.
//
// Model    : on each body -m a and -(I alpha + w x I w) about its centre, with the accelerations of
//            the commanded chain, from the bed outwards:
//              linear axis  a += q'' e + 2 w x q' e        rotary axis  alpha += q'' e + w x q' e
//            q', q'' with the sign of the side. The reaction on the bed comes through the springs
// Units    : rates in mm/s, mm/s^2, rad/s, rad/s^2; load in N and N m, 6 numbers for each body
// Shape    : as structure.hpp
// Errors   : none
// Accuracy : rounding; the columns are those of the mass matrix in relative coordinates
//            (tests/dynamics/laws_test.cpp)
// Source   : recursive Newton-Euler: Luh, Walker, Paul 1980
#pragma once

#include <Eigen/Core>

#include "dynamics/structure.hpp"

namespace frustum::dynamics {

// One column for each axis of the model: its acceleration is 1 m/s^2 or 1 rad/s^2, all else rests.
[[nodiscard]] Eigen::MatrixXd unit_acceleration_loads(const DynamicModel& model,
                                                      const Structure& structure);

[[nodiscard]] Eigen::VectorXd inertial_load(const DynamicModel& model, const Structure& structure,
                                            const kinematics::AxisPositions& velocity,
                                            const kinematics::AxisPositions& acceleration);

// The weight of the bodies, along -Z of the machine.
[[nodiscard]] Eigen::VectorXd weight(const Structure& structure);

constexpr double kGravity = 9.80665;  // m/s^2, the standard value

}  // namespace frustum::dynamics
