// Rotary positions that take the tool axis from where it is to where a program wants it.
//
// Model    : the end is the solution with the least rotary travel within the axes' travel. On the
//            way either the rotary axes run linearly to it, or the tool axis runs on the great
//            circle: then the spherical triangle of the two rotary axes gives their positions in
//            closed form at every fraction t, full turns counted, so that nothing has to be
//            followed step by step. Inside the cone of `pole_tolerance` about the pole the first
//            rotary axis turns evenly from where it comes in to where it goes out, and the second
//            points the tool axis as well as it can.
// Units    : rad; t in [0, 1]; frame: table
// Errors   : unreachable directions at the end or on the way (by how much), rotary positions beyond
//            travel at the end, opposite directions (no great circle)
// Accuracy : 1e-12 rad outside the cone, pole_tolerance inside
//            (tests/kinematics/orientation_path_test.cpp)
#pragma once

#include <vector>

#include "core/pose.hpp"
#include "core/result.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/model/rotary_axes.hpp"

namespace frustum::kinematics {

// 1e-7 rad is 5 nm at the end of a 50 mm cutter: below the bound to which tool paths are sampled.
inline constexpr double kPoleTolerance = 1e-7;  // rad

// Rotary end positions for a tool axis: least travel from `from`, within travel; linear axes as in
// `from`. At the pole (within the tolerance) the free axis stays where it is.
[[nodiscard]] Result<AxisPositions> nearest_orientation(const Machine& machine,
                                                        const AxisPositions& from,
                                                        const Vec3& to_tool_axis,
                                                        double pole_tolerance = kPoleTolerance);

// The way of the rotary axes along the great circle. A value; the machine must outlive it.
class OrientationPath {
 public:
  // Rotary positions at a fraction t of the great circle; linear axes as in `from`. at(0) is
  // `from`.
  [[nodiscard]] AxisPositions at(double t) const;
  [[nodiscard]] AxisPositions end() const { return at(1.0); }
  // The tool axis wanted at t.
  [[nodiscard]] Vec3 tool_axis(double t) const;
  // Inside (0, 1), increasing: where the axes change their law or turn fast. Between neighbours the
  // first rotary axis turns smoothly and by about 15 deg at most on account of the pole; sample at
  // least here.
  [[nodiscard]] const std::vector<double>& breaks() const { return breaks_; }

 private:
  friend class OrientationPathMaker;
  // A part of the way: on one of the two solutions, or inside the pole's cone.
  struct Piece {
    double start = 0.0, end = 0.0;  // rad along the great circle
    bool in_cone = false;
    double sign = 1.0;  // of the solution
    RotaryAngles at_start{}, at_end{};
    RotaryTriangle triangle{};  // at the start
  };
  explicit OrientationPath(const Machine& machine) : axes_(machine) {}
  [[nodiscard]] Vec3 axis_at(double arc) const;
  [[nodiscard]] RotaryAngles angles(const Piece& piece, double arc) const;

  RotaryAxes axes_;
  AxisPositions from_{};
  Vec3 start_ = Vec3::UnitZ();   // tool axis at t = 0
  Vec3 tangent_ = Vec3::Zero();  // unit: where it goes
  double arc_ = 0.0;             // rad, of the great circle
  std::vector<Piece> pieces_{};
  std::vector<double> breaks_{};
};

[[nodiscard]] Result<OrientationPath> orientation_path(const Machine& machine,
                                                       const AxisPositions& from,
                                                       const Vec3& to_tool_axis,
                                                       double pole_tolerance = kPoleTolerance);

}  // namespace frustum::kinematics
