// What small errors do to the tool pose, to first order.
//
// Model    : every error is a small twist (translation tau, rotation theta about a point o) of one
//            frame of a chain: a point r that the frame carries moves by tau + theta x (r - o).
//            Errors of the tool chain move tip and axis so, errors of the work chain move the table
//            the same way and the tool, seen from it, the other way round
// Units    : mm, rad; frames: table, or bed for one side's own chain
// Shape    : one walk along both chains gives the effect of all errors, together or one by one; the
//            effect is linear in them
// Errors   : errors_named: names that the machine does not accept, with the nearest one
// Accuracy : agrees with central differences of actual_pose() to 1e-8 relative on the shipped
//            machines and 1e-6 on random ones (tests/kinematics/error_gain_test.cpp,
//            gain_matrix_test.cpp)
// Source   : first-order rigid motion; where each error acts: chain.hpp
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

// The tip moves by `tip`, the tool turns by the small rotation `turn` about it.
struct PoseDisplacement {
  Vec3 tip = Vec3::Zero();
  Vec3 turn = Vec3::Zero();

  // Of the tool's point that lies `from_tip` off the tip.
  [[nodiscard]] Vec3 at(const Vec3& from_tip) const { return tip + turn.cross(from_tip); }
};

[[nodiscard]] PoseDisplacement first_order_displacement(const Machine& machine,
                                                        const GeometricErrors& errors,
                                                        const AxisState& at, double tool_length);

// One error of a machine under the name it was asked for: an ISO name or one of its aliases.
struct MachineError {
  std::string name{};
  ErrorName error{};
  double scale = 1.0;
  bool carries = false;  // linear axis: the tilt also turns what the axis carries
};

// Every ISO error that the machine accepts, axis by axis.
[[nodiscard]] std::vector<MachineError> every_error(const Machine& machine);
[[nodiscard]] Result<std::vector<MachineError>> errors_named(const Machine& machine,
                                                             std::span<const std::string> names);

// A column an error: displacement (rows 0-2, mm) and turn (rows 3-5, rad) by a unit of it (mm,
// rad).
using GainMatrix = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// Of the tool pose in the table frame.
[[nodiscard]] GainMatrix gain_matrix(const Machine& machine, std::span<const MachineError> errors,
                                     const AxisPositions& at, double tool_length);
// Of a point that the tool (`from_tip`, in the tool's frame) or the table carries (`on_table`), in
// the frame of the bed, by the errors of its own chain; the other chain's columns are zero.
[[nodiscard]] GainMatrix tool_side_gain(const Machine& machine,
                                        std::span<const MachineError> errors,
                                        const AxisPositions& at, double tool_length,
                                        const Vec3& from_tip = Vec3::Zero());
[[nodiscard]] GainMatrix work_side_gain(const Machine& machine,
                                        std::span<const MachineError> errors,
                                        const AxisPositions& at, const Vec3& on_table);

}  // namespace frustum::kinematics
