// Whether a ball bar as it is set up, and what holds its balls, keep clear of the machine.
//
// Model    : the bar is a cylinder between its balls, the spindle ball at the end of a stem along
//            the tool, the table ball on a cup along Z of the table. At samples of the pass their
//            distances from the bodies of the machine file are found, and those of the spindle from
//            the table. Near its balls the bar is not looked at. A tool length below kLeastStem
//            states no stem: the spindle is left out then
// Units    : mm, rad
// Shape    : a sample each two degrees of the parameter, or more
// Errors   : bodies of the machine that cannot be read
// Accuracy : that of stock/collision/convex_distance.hpp at the samples
// Source   : ours; sizes of usual bars
#pragma once

#include <optional>
#include <string>

#include "core/result.hpp"
#include "core/units.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/motion/motion_program.hpp"

namespace frustum::app {

inline constexpr double kBarDiameter = 8.0, kStemDiameter = 20.0;
inline constexpr double kCupDiameter = 25.0, kCupHeight = 25.0;
inline constexpr double kBarEnds = 15.0;                     // beside each ball
inline constexpr double kLeastStem = 60.0;                   // tool length
inline constexpr double kBarBesideStem = 45.0 * kRadPerDeg;  // a bar nearer to it meets its holder

struct BarClearance {
  double distance = 0.0;  // 0: they meet
  std::string first{}, second{};
  double parameter = 0.0;
  bool spindle = false;  // was looked at
};

// Nothing of a machine without bodies.
[[nodiscard]] Result<std::optional<BarClearance>> bar_clearance(const kinematics::Machine& machine,
                                                                const instruments::MotionTest& test,
                                                                const programs::BarPass& pass);

// The least angle between the bar, from its spindle ball, and the tool axis, over the pass.
[[nodiscard]] double least_angle_at_stem(const kinematics::Machine& machine,
                                         const instruments::MotionTest& test,
                                         const programs::BarPass& pass);

}  // namespace frustum::app
