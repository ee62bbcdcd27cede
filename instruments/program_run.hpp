// What an instrument is shown while a control runs the program of a motion test.
//
// Model    : a bar reads where its two balls nominally are a bar's length apart while the parameter
//            of the test runs on: one pass for each contiguous part of the feed in one direction.
//            An R-test and a laser read where the axes rest. The program is not asked what it is
//            of. With servo lag the axes follow their commands late (kinematics/timing/), and a
//            sample is taken when the command is at its angle
// Units    : mm, rad, s
// Shape    : a pose for each pose of the test, with where the axes really are and from which side
//            they came
// Errors   : program-without-test: no pass in the direction asked for, rests that do not fit the
//            poses of the test; capture-short: a pass that does not reach all angles
// Accuracy : positions to rounding without lag; with lag the command is taken straight over 0.5 ms
// Source   : ISO 230-4 and ISO 230-2 by their names
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "instruments/circle_test.hpp"
#include "instruments/cone_test.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/controller/commanded_program.hpp"
#include "kinematics/model/geometric_errors.hpp"
#include "kinematics/model/machine.hpp"
#include "kinematics/timing/time_law.hpp"

namespace frustum::instruments {

struct ProgramRunOptions {
  bool servo_lag = false;
  kinematics::TimeLawOptions time_law{};
};

// Of which a bar's pose is a function: the angle on a circle, of a rotary axis, around a cone.
struct TestParameter {
  std::function<double(const kinematics::AxisPositions&)> of{};
  bool repeats = true;  // each turn of 2 pi; else a position
};
[[nodiscard]] TestParameter circle_parameter(const kinematics::Machine& machine,
                                             const CircleTest& circle);
[[nodiscard]] TestParameter rotary_parameter(kinematics::AxisLetter axis);
[[nodiscard]] TestParameter cone_parameter(const kinematics::Machine& machine,
                                           const ConeTest& cone);

// The poses of the first pass in each direction asked for.
[[nodiscard]] Result<std::vector<std::vector<TestPose>>> bar_passes(
    const kinematics::Machine& machine, const kinematics::GeometricErrors& errors,
    const kinematics::CommandedProgram& program, const MotionTest& test,
    const TestParameter& parameter, std::span<const Sense> senses,
    const ProgramRunOptions& options = {});

// Where the axes rest, in the order of `wanted`: rests elsewhere are passed over.
[[nodiscard]] Result<std::vector<TestPose>> rests_at(const kinematics::GeometricErrors& errors,
                                                     const kinematics::CommandedProgram& program,
                                                     std::span<const TestPose> wanted);

}  // namespace frustum::instruments
