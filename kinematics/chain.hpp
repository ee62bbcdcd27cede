// Forward kinematics: axis positions to the tool's pose in the table frame, with all geometric errors.
//
// Model    : workpiece_from_tool = (product of the work chain)^-1 (product of the tool chain)
//            Trans(spindle offset) Trans(0, 0, -tool length), each joint (side = +1 tool, -1 work):
//              linear        Trans(offset) Trans(location) Trans(line(q) + d(q)) Rot(eps(q))
//              rotary stator Trans(offset) Loc Trans(d(q)) Rot(eps(q)) Rot_e(side q)
//              rotary rotor  Trans(offset) Loc Rot_e(side q) Rot(eps(q)) Trans(d(q))
//            Loc: a rotary axis's location errors move all that it carries; a linear axis's orientation
//            errors only tilt the line along which its functional point p runs, about the joint's origin:
//            line(q) = side q e + (Rot - 1)(side q e + p), unless declared to carry.
//            A volumetric grid moves the whole tool chain: bed_from_tool = Trans(d) Rot(r) (the product above),
//            turning about joint_motion.hpp's grid_pivot.
//            Full rotations throughout; no small-angle shortcut.
// Units    : mm, rad; frame: table (the last joint of the work chain)
// Source   : ISO 230-1, ISO 230-7; exact transforms after machine-tool practice (docs/errors.md)
#pragma once

#include "core/pose.hpp"
#include "kinematics/geometric_errors.hpp"
#include "kinematics/machine.hpp"
#include "kinematics/tool_path.hpp"

namespace frustum::kinematics {

// Pose of the tool (origin: tip, +Z: to the spindle) in the table frame.
[[nodiscard]] Pose nominal_pose(const Machine& machine, const AxisPositions& q, double tool_length);
[[nodiscard]] Pose actual_pose(const Machine& machine, const GeometricErrors& errors,
                               const AxisState& at, double tool_length);

[[nodiscard]] inline ToolPose tool_pose(const Pose& table_from_tool) {
  return {table_from_tool.translation, table_from_tool.rotation.col(2)};
}

// Nominal displacement of the tip in the table frame per unit of X, Y and Z (columns), at fixed
// rotary axes.
[[nodiscard]] Mat3 linear_axis_directions(const Machine& machine, const AxisPositions& q);

}  // namespace frustum::kinematics
