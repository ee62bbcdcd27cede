// How readings change with machine errors and set-up errors, to first order.
//
// Model    : a small error moves the tip by G; bar: u . G, u the unit vector from the table ball
//            to the spindle ball; displacement: G; line: e . G. Set-up: R_tool, -1 and -1 likewise
// Units    : mm per mm and mm per rad; frame: table
// Shape    : a row a reading (an R-test: three a pose), a column an error
// Errors   : none
// Accuracy : 1e-6 relative of differences of exact readings (tests/instruments/gains_test.cpp)
// Source   : kinematics/errors/error_gain.hpp
#pragma once

#include <Eigen/Core>
#include <span>

#include "instruments/line_test.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::instruments {

struct ReadingGains {
  Eigen::MatrixXd errors{};
  Eigen::MatrixXd ball{};     // three columns: common to tests while the ball stays in the spindle
  Eigen::MatrixXd of_test{};  // unknowns of this mounting: table ball and length, or the zero
};

[[nodiscard]] ReadingGains bar_gains(const kinematics::Machine& machine,
                                     std::span<const kinematics::MachineError> errors,
                                     const MotionTest& test);
[[nodiscard]] ReadingGains displacement_gains(const kinematics::Machine& machine,
                                              std::span<const kinematics::MachineError> errors,
                                              const MotionTest& test);
// The laser's zero is free.
[[nodiscard]] ReadingGains line_gains(const kinematics::Machine& machine,
                                      std::span<const kinematics::MachineError> errors,
                                      const LineTest& line, double tool_length);

// At most `most` poses, evenly among those of the test.
[[nodiscard]] MotionTest thinned(const MotionTest& test, std::size_t most);

}  // namespace frustum::instruments
