// R-test: the tip stays at the table ball while the rotary axes go from pose to pose.
//
// Model    : the programmed tip is the centre of the table ball at every pose of the rotary axes;
//            an R-test reads how far it is from there. The three bars of a rotary axis are its
//            components
// Units    : mm, rad; frame: table
// Shape    : a pose each of `rotary`, in their order; parameter: their number
// Errors   : no poses, a pose out of reach, with its number
// Accuracy : nominal positions to rounding
// Source   : Weikert 2004 (R-test); ISO 10791-6 by its name
#pragma once

#include <vector>

#include "core/result.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::instruments {

struct ChaseTest {
  Vec3 table_ball = Vec3::Zero();
  std::vector<kinematics::AxisPositions> rotary{};  // linear axes follow
  double tool_length = 0.0;
};

[[nodiscard]] Result<MotionTest> chase_test(const kinematics::Machine& machine,
                                            const ChaseTest& chase);

// Flat- or ball-ended probes n_i read m_i = n_i . d: d = N^-1 m, rows of N their directions, which
// known steps in X, Y and Z calibrate. Nothing where the directions are in one plane.
[[nodiscard]] Result<Vec3> nest_displacement(const Mat3& directions, const Vec3& readings);
// What a ball-ended probe of radius r on a ball of radius R reads besides, to second order:
// |d_perp|^2 / 2 (R + r).
[[nodiscard]] double sphere_term(const Vec3& displacement, const Vec3& direction, double radii);

}  // namespace frustum::instruments
