// Whether a machine can take the poses of a test.
//
// Units  : mm, rad
// Errors : axis-overtravel: the first pose that cannot be reached, the axes and by how much
#pragma once

#include <optional>
#include <string>

#include "core/diagnostic.hpp"
#include "instruments/motion_test.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::instruments {

// `what` names the parameter of the poses ("phi", "C") in degrees.
[[nodiscard]] std::optional<Diagnostic> out_of_reach(const kinematics::Machine& machine,
                                                     const MotionTest& test,
                                                     const std::string& what);

}  // namespace frustum::instruments
