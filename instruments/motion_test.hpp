// A motion test as it is programmed: where the axes are, and where the instrument nominally is.
//
// Model  : the spindle ball s is at the programmed tip, the table ball b stays on the table. A ball
//          bar reaches from b to s; an R-test sees s in all three directions and has no bar; a
//          laser sees s along a direction
// Units  : mm, rad; frame: table
// Errors : none
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/pose.hpp"
#include "instruments/angle_polynomials.hpp"
#include "kinematics/model/axes.hpp"
#include "kinematics/path/approach_direction.hpp"

namespace frustum::instruments {

struct TestPose {
  double parameter = 0.0;  // rad on a circle, of a rotary axis, around a cone; mm along a line
  // The directions of approach are 0 until with_approach() (approach.hpp) sets them.
  kinematics::AxisState at{};
  Vec3 spindle_ball = Vec3::Zero();  // nominal
};

// The continuous motion that the poses are samples of.
struct TestMotion {
  kinematics::AxisMotion axes{};  // of the parameter; empty: straight from pose to pose
  double from = 0.0;              // in the order in which it is run, with the overshoot
  double to = 0.0;
};

struct MotionTest {
  std::vector<TestPose> poses{};
  TestMotion motion{};
  Vec3 table_ball = Vec3::Zero();
  double bar = 0.0;  // nominal length; 0: an R-test
  double tool_length = 0.0;
  // Of the angles that are the poses' parameters, where all that follows from the poses is such a
  // function of them; whoever changes the poses takes it away.
  std::shared_ptr<const AnglePolynomials> polynomials{};
};

// The poses at angles, of which `pose` gives one; X, Y, Z and the ball are trigonometric
// polynomials of the angle, the rotary axes stand or turn with it.
void take_poses(MotionTest& test, std::span<const double> angles,
                const std::function<TestPose(double)>& pose);

}  // namespace frustum::instruments
