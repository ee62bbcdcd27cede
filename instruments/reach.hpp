// Whether a machine can take the poses of a test, and the bar its readings.
//
// Units  : mm, rad
// Errors : axis-overtravel: the first pose that cannot be reached, the axes and by how much;
//          stroke-exceeded: the first reading that the bar cannot show
#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/diagnostic.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::instruments {

// `what` names the parameter of the poses ("phi", "C") in degrees.
[[nodiscard]] std::optional<Diagnostic> out_of_reach(const kinematics::Machine& machine,
                                                     const MotionTest& test,
                                                     const std::string& what);
// `stroke`: to either side, mm.
[[nodiscard]] std::optional<Diagnostic> beyond_stroke(const MotionTest& test,
                                                      std::span<const double> readings,
                                                      double stroke, const std::string& what);

}  // namespace frustum::instruments
