#include "kinematics/model/actual_inverse.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "kinematics/model/chain.hpp"

namespace frustum::kinematics {
namespace {

// Errors change by some 1e-5 of what the axes move, so that each step gains five digits.
constexpr int kSteps = 4;

using RotaryJoints = std::array<const Joint*, 2>;
using TurnOfAxis = Eigen::Matrix<double, 3, 2>;

RotaryJoints rotary_axes(const Machine& machine) {
  RotaryJoints axes{};
  std::size_t count = 0;
  for (const auto* chain : {&machine.tool_chain(), &machine.work_chain()}) {
    for (const Joint& joint : *chain) {
      if (joint.rotary()) axes.at(count++) = &joint;
    }
  }
  return axes;
}

// How the tool axis moves per radian of each rotary axis on the nominal machine.
TurnOfAxis turn_of_axis(const Machine& machine, const RotaryJoints& rotary,
                        const AxisPositions& q) {
  constexpr double kStep =
      1e-4;  // rad: central differences good to 1e-9, ample for a Newton matrix
  TurnOfAxis turn = TurnOfAxis::Zero();
  for (std::size_t k = 0; k < rotary.size(); ++k) {
    if (rotary[k] == nullptr) continue;
    AxisPositions ahead = q, behind = q;
    ahead[rotary[k]->letter] += kStep;
    behind[rotary[k]->letter] -= kStep;
    turn.col(static_cast<Eigen::Index>(k)) = (tool_pose(nominal_pose(machine, ahead, 0.0)).axis -
                                              tool_pose(nominal_pose(machine, behind, 0.0)).axis) /
                                             (2.0 * kStep);
  }
  return turn;
}

}  // namespace

AxisPositions actual_inverse(const Machine& machine, const GeometricErrors& errors,
                             const ToolPose& wanted, double tool_length, const AxisState& nominal,
                             const ActualInverseOptions& options) {
  const RotaryJoints rotary = rotary_axes(machine);
  const TurnOfAxis turn = turn_of_axis(machine, rotary, nominal.q);
  const double damping = options.stiffness * options.stiffness;
  const Eigen::LDLT<Eigen::Matrix2d> normal(turn.transpose() * turn +
                                            damping * Eigen::Matrix2d::Identity());
  const Eigen::PartialPivLU<Mat3> linear(linear_axis_directions(machine, nominal.q));

  AxisState at = nominal;
  Eigen::Vector2d correction = Eigen::Vector2d::Zero();
  for (int step = 0; step < kSteps; ++step) {
    const ToolPose actual = tool_pose(actual_pose(machine, errors, at, tool_length));
    const Vec3 missing = wanted.axis - actual.axis;
    const Eigen::Vector2d further = normal.solve(turn.transpose() * missing - damping * correction);
    correction += further;
    for (std::size_t k = 0; k < rotary.size(); ++k) {
      if (rotary[k] != nullptr) at.q[rotary[k]->letter] += further[static_cast<Eigen::Index>(k)];
    }
    // Twice: the first placing moves the linear axes by what the turn displaced the tip, which may
    // be hundreds of their errors' scale.
    for (int placing = 0; placing < 2; ++placing) {
      const Vec3 off = wanted.tip - tool_pose(actual_pose(machine, errors, at, tool_length)).tip;
      const Vec3 move = linear.solve(off);
      at.q[AxisLetter::X] += move.x();
      at.q[AxisLetter::Y] += move.y();
      at.q[AxisLetter::Z] += move.z();
    }
  }
  return at.q;
}

}  // namespace frustum::kinematics
