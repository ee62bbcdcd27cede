// What the tip deviates by while the axes move as commanded.
//
// Model    : quasi-static: in each sample K(q)^-1 f(q, q', q''), without vibration; good to
//            (frequency of the motion / first natural frequency)^2.
//            linear: M x'' + D x' + K x = f in absolute coordinates of the machine, so that x goes
//            on when the matrices are renewed: each time that an axis has moved on by 1 mm or
//            1 deg, as they are in the middle of that way. Load, tip and table are those of each
//            sample; in between the load is linear in time and the step exact. Starts at rest
//            without deviation. Controlled axes have their loops (servo.hpp)
// Units    : samples mm, rad, s; deviations m, rad, in the frame of the table
// Shape    : samples evenly spaced in time
// Errors   : none
// Accuracy : 0.05 um against full rotations (tests/dynamics/motion_test.cpp)
// Source   : ETH thesis, chapter 6; Franklin, Powell, Workman, chapter 6
#pragma once

#include <span>
#include <vector>

#include "dynamics/dynamic_model.hpp"
#include "kinematics/model/axes.hpp"

namespace frustum::dynamics {

struct MotionSample {
  kinematics::AxisPositions position{}, velocity{}, acceleration{};
};

// Rates of positions that are `step` seconds apart, at rest before and after: accelerations are
// second differences, which are the mean weighted by a triangle of two steps and lose
// (pi f step)^2 / 3 of an amplitude at f.
[[nodiscard]] std::vector<MotionSample> with_rates(
    std::span<const kinematics::AxisPositions> positions, double step);

struct TipDeviation {
  Vec3 tip = Vec3::Zero();
  Vec3 turn = Vec3::Zero();
};

[[nodiscard]] std::vector<TipDeviation> quasi_static_deviations(
    const DynamicModel& model, std::span<const MotionSample> samples, double tool_length);

struct RenewalDistance {
  double linear = 1.0;               // mm
  double rotary = 1.0 * kRadPerDeg;  // rad
};
[[nodiscard]] std::vector<TipDeviation> linear_deviations(const DynamicModel& model,
                                                          std::span<const MotionSample> samples,
                                                          double step, double tool_length,
                                                          const RenewalDistance& renewal = {});

}  // namespace frustum::dynamics
