// One axis moves from rest to rest with limited jerk: what the tip does meanwhile and afterwards.
//
// Model    : acceleration in up to seven phases, linear in each; the structure as it is where the
//            move begins, with the springs of the drives, in exact steps (time_step.hpp)
// Units    : m, rad, s
// Shape    : rows each 10 ms, on for 0.2 s after the move and for 0.6 s at least
// Errors   : none; distance, limits and jerk above 0
// Accuracy : 1e-6 of the largest deviation (tests/dynamics/motion_test.cpp)
// Source   : the fastest motion within the limits, symmetric in time
#pragma once

#include <array>
#include <vector>

#include "dynamics/servo.hpp"

namespace frustum::dynamics {

struct MoveLimits {
  double distance = 0.0;  // of either sign
  double velocity = 0.0;
  double acceleration = 0.0;
  double jerk = 0.0;
};

// Time and acceleration at the ends of the phases.
struct Breakpoint {
  double time = 0.0;
  double acceleration = 0.0;
};
[[nodiscard]] std::vector<Breakpoint> jerk_profile(const MoveLimits& limits);

struct JerkMove {
  std::vector<Breakpoint> breakpoints{};
  struct Row {
    double time = 0.0;
    Vec3 tip = Vec3::Zero();
  };
  std::vector<Row> rows{};
  // Largest |x|, |y|, |z| in the frame of the machine.
  Vec3 largest = Vec3::Zero();        // looked for each 5 ms
  Vec3 largest_after = Vec3::Zero();  // the same from the end of the move on
  Vec3 peak = Vec3::Zero();           // looked for each 0.5 ms
};
[[nodiscard]] JerkMove jerk_move(const DynamicModel& model, const kinematics::AxisPositions& q,
                                 double tool_length, std::size_t axis, const MoveLimits& limits);

}  // namespace frustum::dynamics
