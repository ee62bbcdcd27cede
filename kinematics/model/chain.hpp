// Forward kinematics: axis positions to the tool's pose in the table frame, with all geometric
// errors.
//
// Model    : workpiece_from_tool = (product of the work chain)^-1 (product of the tool chain)
//            Trans(spindle offset) Trans(0, 0, -tool length), each joint (side = +1 tool, -1 work):
//              linear        Trans(offset) Trans(location) Trans(line(q) + d(q)) Rot(eps(q))
//              rotary stator Trans(offset) Loc Trans(d(q)) Rot(eps(q)) Rot_e(side q)
//              rotary rotor  Trans(offset) Loc Rot_e(side q) Rot(eps(q)) Trans(d(q))
//            Loc: a rotary axis's location errors move all that it carries; a linear axis's
//            orientation errors only tilt the line along which its functional point p runs, about
//            the joint's origin: line(q) = side q e + (Rot - 1)(side q e + p), unless declared to
//            carry. A volumetric grid moves the whole tool chain: bed_from_tool = Trans(d) Rot(r)
//            (the product above), turning about joint_motion.hpp's grid_pivot.
//            Full rotations throughout; no small-angle shortcut.
// Units    : mm, rad; frame: table (the last joint of the work chain)
// Errors   : none: every position has a pose, within travel or not
// Speed    : bench/kinematics_bench.cpp
// Source   : ISO 230-1, ISO 230-7; exact transforms after machine-tool practice (docs/errors.md)
#pragma once

#include <array>
#include <span>

#include "core/pose.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/model/tool_pose.hpp"

namespace frustum::kinematics {

struct SineCosine;
class PoseRows;

// The chain of one machine with its errors and one tool, prepared once for many poses: what does
// not depend on the axis positions is multiplied out beforehand. Refers to `errors`, which must
// outlive it.
class ForwardChain {
 public:
  // Both must outlive the chain.
  ForwardChain(const Machine& machine, const GeometricErrors& errors, double tool_length);
  ForwardChain(const Machine& machine, GeometricErrors&& errors, double tool_length) = delete;

  // Pose of the tool (origin: tip, +Z: to the spindle) in the table frame.
  [[nodiscard]] Pose table_from_tool(const AxisState& at) const;
  // Each side's own chain, in the frame of the bed.
  [[nodiscard]] Pose bed_from_tool(const AxisState& at) const;
  [[nodiscard]] Pose bed_from_table(const AxisState& at) const;
  // No error depends on where the axes are: poses are as smooth as nominal ones.
  [[nodiscard]] bool locations_only() const;

 private:
  enum class Motion : std::uint8_t { linear, about_x, about_y, about_z, about_any };
  // Where the component rotations of a joint turn: at the origin of its frame, at a point of it, or
  // at the nominal end of the chain.
  enum class Pivot : std::uint8_t { origin, point, end };

  struct Link {
    AxisLetter letter = AxisLetter::X;
    Motion motion = Motion::linear;
    Pivot pivot = Pivot::origin;
    bool carries = false;                   // the location errors turn what it carries
    bool tilted = false;                    // linear: line is not the nominal one
    bool needs_end = false;                 // it, or a joint nearer to the bed, turns about the end
    const AxisErrors* component = nullptr;  // null: no component errors
    Vec3 direction = Vec3::UnitX();         // of the moving part for +q
    Vec3 offset = Vec3::Zero();
    Vec3 place = Vec3::Zero();  // offset with the location errors
    Vec3 point = Vec3::Zero();
    Mat3 carried = Mat3::Identity();
    Mat3 line = Mat3::Identity();
  };

  void prepare(Link& link, const Joint& joint, const AxisErrors& errors);
  // From the end of the chain back to the bed, so that the nominal place of the end, about which
  // some errors turn, comes along the way.
  [[nodiscard]] PoseRows walk(std::span<const Link> links, const Vec3& end,
                              const AxisState& at) const;
  void prepend_linear(const Link& link, const AxisState& at, Vec3& end, PoseRows& pose) const;
  void prepend_rotary(const Link& link, const AxisState& at, Vec3& end, PoseRows& pose) const;
  void turn_about_pivot(const Link& link, const Vec3& turn, const Vec3& end, PoseRows& pose) const;
  static void rotate(const Link& link, const SineCosine& q, PoseRows& pose);
  static void place(const Link& link, PoseRows& pose);
  [[nodiscard]] PoseRows tool_rows(const AxisState& at) const;
  [[nodiscard]] PoseRows table_rows(const AxisState& at) const;

  // A volumetric grid moves the whole tool chain.
  void move_by_grid(const AxisState& at, PoseRows& pose) const;

  static constexpr std::size_t kMostJoints = 5;
  const Machine* machine_;
  const GeometricErrors* grids_;           // null: no volumetric grid
  std::array<Link, kMostJoints> links_{};  // tool chain, then work chain
  std::size_t tool_count_ = 0;
  std::size_t count_ = 0;
  Vec3 tip_ = Vec3::Zero();    // in the frame of the tool chain's last joint
  Vec3 table_ = Vec3::Zero();  // in the frame of the work chain's last joint
  RotationOrder order_ = RotationOrder::zyx;
  RotaryErrorFrame frame_ = RotaryErrorFrame::stator;
};

[[nodiscard]] Pose nominal_pose(const Machine& machine, const AxisPositions& q, double tool_length);
// For a single pose; many poses are cheaper with a ForwardChain.
[[nodiscard]] Pose actual_pose(const Machine& machine, const GeometricErrors& errors,
                               const AxisState& at, double tool_length);

[[nodiscard]] inline ToolPose tool_pose(const Pose& table_from_tool) {
  return {table_from_tool.translation, table_from_tool.rotation.col(2)};
}

// Nominal displacement of the tip in the table frame per unit of X, Y and Z (columns), at fixed
// rotary axes.
[[nodiscard]] Mat3 linear_axis_directions(const Machine& machine, const AxisPositions& q);

}  // namespace frustum::kinematics
