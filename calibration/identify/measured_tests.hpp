// Motion tests and their readings as motion_observations.hpp takes them.
//
// Model    : rows of a bar: mean, cos, sin, cos2, sin2 over its angle, by least squares over all
//            runs; on a circle backlash and servo mismatch are fitted beside. Its mounting: table
//            ball and length. Of an R-test: x, y, z of every pose; its mounting: the table ball. Of
//            diagonals: the slope times the length of each; their mounting: the zero of each and
//            one scale for all. Of touches: the six errors of every pose of A and C; their
//            mounting: place and tilt of the artefact
// Units    : mm, rad
// Shape    : as named
// Errors   : arc-too-short: angles that do not separate the harmonics
// Accuracy : of the functions that read: instruments/
// Source   : ours
#pragma once

#include <span>
#include <string>
#include <vector>

#include "calibration/identify/motion_observations.hpp"
#include "core/result.hpp"
#include "instruments/circle_test.hpp"
#include "instruments/line_test.hpp"
#include "instruments/touch_plan.hpp"
#include "instruments/touch_test.hpp"

namespace frustum::calibration {

struct TestHead {
  std::string name{};
  std::string ball{};  // as of MeasuredMotion
  double tool_length = 0.0;
  double noise = 0.0;  // 0: what the residuals show, where there are any
};

struct BarRun {
  instruments::Sense sense = instruments::Sense::ccw;
  instruments::MotionTest test{};
  std::vector<double> readings{};
};
using BarRuns = std::vector<BarRun>;

[[nodiscard]] Result<MeasuredMotion> measured_circle(const kinematics::Machine& machine,
                                                     const TestHead& head, const BarRuns& runs);
[[nodiscard]] Result<MeasuredMotion> measured_turn(const kinematics::Machine& machine,
                                                   const TestHead& head, const BarRuns& runs);
[[nodiscard]] Result<MeasuredMotion> measured_chase(const kinematics::Machine& machine,
                                                    const TestHead& head,
                                                    const instruments::MotionTest& test,
                                                    std::span<const Vec3> readings);
// `names`: the signs of each line; readings by line, from its first point on.
[[nodiscard]] Result<MeasuredMotion> measured_diagonals(
    const kinematics::Machine& machine, const TestHead& head, std::span<const std::string> names,
    std::span<const instruments::LineTest> lines, const std::vector<std::vector<double>>& readings);
[[nodiscard]] Result<MeasuredMotion> measured_touches(const kinematics::Machine& machine,
                                                      const TestHead& head,
                                                      const instruments::TouchPlan& plan,
                                                      const instruments::TouchProbe& probe,
                                                      std::span<const double> readings);

}  // namespace frustum::calibration
