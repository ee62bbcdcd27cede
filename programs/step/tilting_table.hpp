// A rotary table that turns about the vertical and tilts about a horizontal machine axis.
//
// Model    : two rotary axes on the workpiece side, the outer one along +-X or +-Y (tilt), the
//            inner one along +-Z (turn). Definitions are written for a tilt A about X and a turn C
//            about Z; on this machine X represents the tilt axis, that is definition directions are
//            turned by `orientation` about Z. Axis values follow from the senses of the joints, so
//            that the nominal rotation of the table is the definition's.
// Units    : mm, rad; frame: table
// Shape    : at most one shortfall an axis, in the order of the machine's joints
// Errors   : machines of another kind, with the reason; shortfalls() never fails
// Accuracy : the nominal table turns as the definition within 1e-12
//            (tests/programs/step_geometry_test.cpp); limits hold within half a nanometre or
//            nanoradian
// Source   : Ibaraki et al. 2010, equations (1)-(5), for the definition's table
#pragma once

#include <string>
#include <vector>

#include "core/result.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::programs {

struct TiltingTable {
  kinematics::AxisLetter tilt = kinematics::AxisLetter::A;
  kinematics::AxisLetter turn = kinematics::AxisLetter::C;
  double tilt_sense = 1.0, turn_sense = 1.0;  // of the joints against +X or +Y, and +Z
  double orientation = 0.0;      // rad about Z, from the definition's X to the tilt axis
  Vec3 crossing = Vec3::Zero();  // of both axes; on the turn axis if they miss each other

  [[nodiscard]] static Result<TiltingTable> of(const kinematics::Machine& machine);

  // Rotary positions for the definition's A and C; C by whole turns into its travel if it can be.
  [[nodiscard]] kinematics::AxisPositions positions(const kinematics::Machine& machine, double a,
                                                    double c) const;
};

// An axis outside its travel.
struct Shortfall {
  kinematics::AxisLetter axis = kinematics::AxisLetter::X;
  double position = 0.0;  // mm or rad
  double missing = 0.0;   // travel that is short
  std::string text{};     // "A = 90 deg, travel -45 .. 45 deg: 45 deg short"
};
[[nodiscard]] std::vector<Shortfall> shortfalls(const kinematics::Machine& machine,
                                                const kinematics::AxisPositions& q);

}  // namespace frustum::programs
