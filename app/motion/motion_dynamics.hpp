// What masses and springs of the machine move the tip by while the axes run a motion test at a
// feed.
//
// Model    : the way is run once, from rest to rest, by the time law of the machine's limits
//            (kinematics/timing/time_law.hpp); the deviation of dynamics/path_response.hpp when
//            each sample is passed. A turn in steady state is circle_dynamics.hpp
// Units    : mm, rad, s; frame: table
// Shape    : a deviation for each parameter
// Errors   : a word that is no method, a method without a feed and the other way round, a machine
//            without [dynamics], an unstable control
// Accuracy : that of path_response.hpp (tests/app/motion_dynamics_test.cpp)
// Source   : ISO 230-4 and ISO 10791-6 run tests at a feed
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "app/motion/motion_words.hpp"
#include "core/result.hpp"
#include "dynamics/path_deviation.hpp"
#include "instruments/line_test.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/timing/time_law.hpp"

namespace frustum::app {

// Nothing moves the tip where the method is off.
struct MotionDynamics {
  dynamics::PathMethod method = dynamics::PathMethod::off;
  std::optional<dynamics::DynamicModel> model{};
  kinematics::TimeLawOptions law{};

  [[nodiscard]] bool is_on() const { return model.has_value(); }
};
// `feed`: what the words say; `at`: where the control has to be stable.
[[nodiscard]] Result<MotionDynamics> motion_dynamics(const MotionWords& words,
                                                     const MotionSetup& setup,
                                                     const std::optional<double>& feed,
                                                     const kinematics::AxisPositions& at);

// Axis positions of a parameter, which goes from `from` to `to` at `speed` per second.
struct TimedWay {
  std::function<kinematics::AxisPositions(double)> axes{};
  double from = 0.0, to = 0.0;
  double speed = 1.0;
  std::vector<double> corners{};  // where a new block begins, between the ends
};
// Through the poses of a line, as far beyond the last one as it begins before the first; the
// parameter is mm from the beginning.
[[nodiscard]] TimedWay way_of(const instruments::LineTest& line, double speed);
[[nodiscard]] std::vector<double> parameters_on(const instruments::LineTest& line);

[[nodiscard]] std::vector<Vec3> deviations_on(const MotionDynamics& moved,
                                              const kinematics::Machine& machine,
                                              const TimedWay& way, double tool_length,
                                              std::span<const double> parameters);

// At each pose of a test whose parameter goes on by `per_feed` for a unit of feed; empty where
// nothing moves the tip. A feed without dynamics is refused: such a test is at rest.
[[nodiscard]] Result<std::vector<Vec3>> deviations_of(
    const MotionWords& words, const MotionSetup& setup, const instruments::MotionTest& test,
    const std::optional<double>& feed, double per_feed, const std::vector<double>& corners = {});
[[nodiscard]] Result<std::vector<Vec3>> deviations_of(const MotionWords& words,
                                                      const MotionSetup& setup,
                                                      const instruments::LineTest& line,
                                                      const std::optional<double>& feed);

}  // namespace frustum::app
