#include "dynamics/servo.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/constants.hpp"
#include "core/general_algebra.hpp"
#include "dynamics/inertial_load.hpp"

namespace frustum::dynamics {
namespace {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

MatrixXd widened(const MatrixXd& matrix, Index rows, Index columns) {
  MatrixXd wide = MatrixXd::Zero(rows, columns);
  wide.topLeftCorner(matrix.rows(), matrix.cols()) = matrix;
  return wide;
}

bool is_screw(const AxisModel& axis) { return axis.control->kind == Control::Kind::screw; }

ServoLoop loop_of(const DynamicModel& model, const Structure& structure, std::size_t k,
                  Index coordinates, std::optional<Index> motor) {
  const AxisModel& axis = model.axes[k];
  const auto seen_at = [&](const Vec3& at, Attached on) {
    VectorXd row = VectorXd::Zero(coordinates);
    row.head(structure.coordinates()) =
        row_along_axis(model, structure, k, at, on).dense(structure.coordinates());
    return row;
  };
  ServoLoop loop{.axis = k, .control = *axis.control, .side = double(axis.joint.side)};
  loop.acts =
      motor ? VectorXd(VectorXd::Unit(coordinates, *motor)) : seen_at(axis.drive.at, axis.drive.on);
  const auto& scale = axis.control->scale;
  loop.position = scale ? seen_at(scale->at, scale->on) : loop.acts;
  loop.velocity = motor ? loop.acts : loop.position;
  return loop;
}

void add_screw(ServoSystem& s, const Control& control, const VectorXd& drive, Index motor) {
  VectorXd stretch = -drive;
  stretch[motor] = 1.0;
  s.stiffness += control.screw.stiffness * stretch * stretch.transpose();
  s.damping += control.screw.damping * stretch * stretch.transpose();
  s.mass(motor, motor) = control.motor_inertia;
  s.mass_root(motor, motor) = std::sqrt(control.motor_inertia);
}

// From e to F, at i w.
Complex controller(const Control& control, Complex derivative) {
  Complex gain = control.velocity_gain;
  if (control.integral_time) gain += control.velocity_gain / (*control.integral_time * derivative);
  return gain;
}

// What the command adds to e for each unit of q', and to F for each unit of q''.
double velocity_missing(const ServoLoop& loop) {
  return -loop.side * (1.0 - loop.control.feed_forward_velocity);
}
double force_forward(const ServoLoop& loop) {
  return loop.side * loop.control.feed_forward_acceleration * loop.control.reference_inertia;
}

}  // namespace

Index ServoSystem::states() const {
  Index count = 2 * coordinates();
  for (const ServoLoop& loop : loops) count += loop.control.integral_time ? 1 : 0;
  return count;
}

ServoSystem servo_system(const DynamicModel& model, const kinematics::AxisPositions& q,
                         double tool_length, Drives drives) {
  const Structure structure = structure_at(model, q, tool_length, drives);
  const auto is_looped = [&](const AxisModel& a) { return a.control && drives == Drives::none; };
  const Index bodies = structure.coordinates();
  Index n = bodies;
  for (const AxisModel& axis : model.axes) n += is_looped(axis) && is_screw(axis) ? 1 : 0;
  ServoSystem s;
  s.mass_root = widened(mass_root(structure), n, n);
  s.mass = widened(structure.mass, n, n);
  s.stiffness = widened(structure.stiffness, n, n);
  s.damping = widened(structure.damping, n, n);
  s.tip = widened(structure.tip, 6, n);
  const MatrixXd loads = unit_acceleration_loads(model, structure);
  s.unit_acceleration_loads = widened(loads, n, loads.cols());
  s.machine_from_table = structure.machine_from_table;
  Index motor = bodies;
  for (std::size_t k = 0; k < model.axes.size(); ++k) {
    const AxisModel& axis = model.axes[k];
    if (!is_looped(axis)) continue;
    if (!is_screw(axis)) {
      s.loops.push_back(loop_of(model, structure, k, n, std::nullopt));
      continue;
    }
    VectorXd drive = VectorXd::Zero(n);
    drive.head(bodies) =
        row_along_axis(model, structure, k, axis.drive.at, axis.drive.on).dense(bodies);
    add_screw(s, *axis.control, drive, motor);
    s.unit_acceleration_loads(motor, static_cast<Index>(k)) =
        -axis.joint.side * axis.control->motor_inertia;
    s.loops.push_back(loop_of(model, structure, k, n, motor++));
  }
  return s;
}

HarmonicSystem harmonic_system(const ServoSystem& system, double frequency) {
  const double w = kTurn * frequency;
  const Complex derivative(0.0, w);
  HarmonicSystem h{MatrixXcd(system.coordinates(), system.coordinates()), system.tip.topRows(3)};
  h.dynamic_stiffness.real() = system.stiffness - w * w * system.mass;
  h.dynamic_stiffness.imag() = w * system.damping;
  for (const ServoLoop& loop : system.loops) {
    const VectorXcd seen = loop.control.position_gain * loop.position.cast<Complex>() +
                           derivative * loop.velocity.cast<Complex>();
    h.dynamic_stiffness +=
        controller(loop.control, derivative) * loop.acts.cast<Complex>() * seen.transpose();
  }
  return h;
}

Eigen::Matrix3Xcd tracking_deviation(const ServoSystem& system, double frequency) {
  const Complex derivative(0.0, kTurn * frequency);
  MatrixXcd loads = derivative * derivative * system.unit_acceleration_loads.cast<Complex>();
  for (const ServoLoop& loop : system.loops) {
    loads.col(static_cast<Index>(loop.axis)) +=
        (controller(loop.control, derivative) * velocity_missing(loop) * derivative +
         force_forward(loop) * derivative * derivative) *
        loop.acts.cast<Complex>();
  }
  return tip_response(harmonic_system(system, frequency), loads);
}

StateSpace state_space(const ServoSystem& system) {
  const Index n = system.coordinates(), count = system.states();
  const MatrixXd k = mass_normalised(system.mass_root, system.stiffness);
  // Velocities in units of a frequency of the machine, so that both halves weigh alike.
  const double w = std::sqrt(k.trace() / static_cast<double>(n));
  const MatrixXd to_root =
      system.mass_root.triangularView<Eigen::Lower>().solve(MatrixXd::Identity(n, n));
  StateSpace s;
  s.matrix = MatrixXd::Zero(count, count);
  s.matrix.block(0, n, n, n) = w * MatrixXd::Identity(n, n);
  s.matrix.block(n, 0, n, n) = -k / w;
  s.matrix.block(n, n, n, n) = -mass_normalised(system.mass_root, system.damping);
  s.from_positions = s.from_velocities = s.from_loads = MatrixXd::Zero(count, n);
  s.positions = s.velocities = MatrixXd::Zero(n, count);
  s.from_positions.topRows(n) = w * system.mass_root.transpose();
  s.from_velocities.middleRows(n, n) = system.mass_root.transpose();
  s.from_loads.middleRows(n, n) = to_root;
  s.positions.leftCols(n) = to_root.transpose() / w;
  s.velocities.middleCols(n, n) = to_root.transpose();
  s.from_integrals = MatrixXd::Zero(count, count - 2 * n);
  s.integrals = MatrixXd::Zero(count - 2 * n, count);
  Index z = 2 * n;
  for (const ServoLoop& loop : system.loops) {
    const VectorXd acts = to_root * loop.acts;
    Eigen::RowVectorXd error = Eigen::RowVectorXd::Zero(count);  // e of a state
    error.head(n) = -loop.control.position_gain / w * (to_root * loop.position).transpose();
    error.segment(n, n) = -(to_root * loop.velocity).transpose();
    s.matrix.middleRows(n, n) += loop.control.velocity_gain * acts * error;
    if (!loop.control.integral_time) continue;
    const double integral_gain = loop.control.velocity_gain / *loop.control.integral_time;
    const double scale = std::sqrt(integral_gain * acts.norm() / error.segment(n, n).norm());
    s.matrix.block(n, z, n, 1) = integral_gain / scale * acts;
    s.matrix.row(z) = scale * error;
    s.from_integrals(z, z - 2 * n) = scale;
    s.integrals(z - 2 * n, z) = 1.0 / scale;
    ++z;
  }
  return s;
}

VectorXd input_of(const ServoSystem& system, const StateSpace& space, const VectorXd& load,
                  const VectorXd& velocity, const VectorXd& acceleration) {
  const Index n = system.coordinates();
  VectorXd force = VectorXd::Zero(n);
  force.head(load.size()) = load;
  // Motors carry no body: what they ask for is the acceleration of their own axis.
  force.tail(n - load.size()) =
      system.unit_acceleration_loads.bottomRows(n - load.size()) * acceleration;
  VectorXd input = VectorXd::Zero(space.matrix.rows());
  Index z = 0;
  for (const ServoLoop& loop : system.loops) {
    const auto k = static_cast<Index>(loop.axis);
    const double error = velocity_missing(loop) * velocity[k];
    force +=
        (loop.control.velocity_gain * error + force_forward(loop) * acceleration[k]) * loop.acts;
    if (loop.control.integral_time) input += space.from_integrals.col(z++) * error;
  }
  return input + space.from_loads * force;
}

Poles poles_of(const ServoSystem& system) {
  return sorted_poles(general_eigen(state_space(system).matrix, false).values);
}

std::optional<Diagnostic> instability(const DynamicModel& model, const ServoSystem& system) {
  if (system.loops.empty()) return std::nullopt;
  const StateSpace space = state_space(system);
  const GeneralEigen eigen = general_eigen(space.matrix, true);
  Index worst = 0;
  eigen.values.real().maxCoeff(&worst);
  const Complex pole = eigen.values[worst];
  if (pole.real() < 0.0) return std::nullopt;
  // The energy that each loop holds as the spring that it is.
  const VectorXcd motion = space.positions * eigen.vectors.col(worst);
  const ServoLoop* to_blame = nullptr;
  double most = -1.0, sum = 0.0;
  for (const ServoLoop& loop : system.loops) {
    const double seen = std::abs((loop.position.transpose() * motion)(0));
    const double energy = loop.control.position_gain * loop.control.velocity_gain * seen * seen;
    sum += energy;
    if (energy <= most) continue;
    most = energy;
    to_blame = &loop;
  }
  const std::string axis = model.body_name(to_blame->axis + 1);
  Diagnostic problem = error(
      "unstable-control"_id,
      fmt::format("the control of axis {} is unstable: a pole at {:.4g} 1/s, {:.4g} Hz, of which "
                  "this axis has {:.0f} %",
                  axis, pole.real(), std::abs(pole.imag()) / kTurn,
                  sum > 0.0 ? 100.0 * most / sum : 100.0),
      "lower kv or kp, raise tn, or damp the mode");
  problem.key = fmt::format("dynamics.axis.{}.control", axis);
  const Control::Place& place = to_blame->control.place;
  problem.file = place.file;
  problem.line = place.line;
  problem.column = place.column;
  return problem;
}

}  // namespace frustum::dynamics
