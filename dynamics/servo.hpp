// The machine with its drives: springs, or motors in a cascade of position and velocity loop.
//
// Model    : deviations from the command, side s, position error p and velocity error v of the
//            encoders along +e of the moving part:
//              e = -Kv p - v' - s (1 - fv) q',  z' = e,  F = Kp e + Kp/Tn z + s fa m q''
//            direct: F acts where the drive is, both encoders are there or at the scale.
//            screw: one more coordinate, the motor, as travel relative to the part before:
//              mm (n'' + s q'') = F - k (n - p_drive) - d (n' - p_drive')
//            k and d pull the parts; the velocity is the motor's, the position the scale's or the
//            motor's. Axes without control keep the springs of their drives
// Units    : SI
// Shape    : coordinates of structure.hpp, then one for each screw; states: positions, velocities,
//            one z for each integral part
// Errors   : a pole that does not decay names the axis with the largest share in it
// Accuracy : poles 1e-7, responses 1e-8 of the largest entry (tests/dynamics/servo_test.cpp)
// Source   : cascade control: Gross, Hamann, Wiegaertner, Electrical Feed Drives, chapter 5
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/diagnostic.hpp"
#include "dynamics/modes.hpp"
#include "dynamics/response.hpp"
#include "dynamics/structure.hpp"

namespace frustum::dynamics {

struct ServoLoop {
  std::size_t axis = 0;  // of the model
  Control control{};
  double side = 1.0;
  Eigen::VectorXd acts{};      // where a force of 1 N is, in all coordinates
  Eigen::VectorXd position{};  // what the encoders see of them
  Eigen::VectorXd velocity{};
};

struct ServoSystem {
  Eigen::MatrixXd mass_root{};
  Eigen::MatrixXd mass{}, stiffness{}, damping{};
  Eigen::MatrixXd tip{};                      // 6 rows
  Eigen::MatrixXd unit_acceleration_loads{};  // a column for each axis, motors too
  std::vector<ServoLoop> loops{};
  Mat3 machine_from_table = Mat3::Identity();

  [[nodiscard]] Eigen::Index coordinates() const { return stiffness.rows(); }
  [[nodiscard]] Eigen::Index states() const;
};

// `drives`: none for the loops of controlled axes, springs to leave all controls out.
[[nodiscard]] ServoSystem servo_system(const DynamicModel& model,
                                       const kinematics::AxisPositions& q, double tool_length,
                                       Drives drives = Drives::none);

// Above 0 Hz: at rest an integral part is infinitely stiff.
[[nodiscard]] HarmonicSystem harmonic_system(const ServoSystem& system, double frequency);
// What the tip is off by for a unit (m, rad) of harmonic command of each axis.
[[nodiscard]] Eigen::Matrix3Xcd tracking_deviation(const ServoSystem& system, double frequency);

// y' = a y + input, whose coordinates are balanced; y from positions, velocities and z.
struct StateSpace {
  Eigen::MatrixXd matrix{};
  Eigen::MatrixXd from_positions{};   // a column for each coordinate: y of a displacement
  Eigen::MatrixXd from_velocities{};  // y of a velocity
  Eigen::MatrixXd from_loads{};       // input of a load
  Eigen::MatrixXd from_integrals{};   // y of each z
  Eigen::MatrixXd positions{};        // and back
  Eigen::MatrixXd velocities{};
  Eigen::MatrixXd integrals{};
};
[[nodiscard]] StateSpace state_space(const ServoSystem& system);
// What a load on the bodies and the rates of the axes (SI, in the order of the model) put in.
[[nodiscard]] Eigen::VectorXd input_of(const ServoSystem& system, const StateSpace& space,
                                       const Eigen::VectorXd& load, const Eigen::VectorXd& velocity,
                                       const Eigen::VectorXd& acceleration);

[[nodiscard]] Poles poles_of(const ServoSystem& system);
[[nodiscard]] std::optional<Diagnostic> instability(const DynamicModel& model,
                                                    const ServoSystem& system);

}  // namespace frustum::dynamics
