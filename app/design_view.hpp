// A choice of step patterns for people and for programs.
// Units: um and urad. Errors: none.
#pragma once

#include <string>

#include "calibration/step_design.hpp"
#include "kinematics/machine.hpp"

namespace frustum::app {

// `limited`: standard deviations were asked for.
[[nodiscard]] std::string design_text(const kinematics::Machine& machine,
                                      const calibration::StepDesign& design, bool limited);
[[nodiscard]] std::string design_json(const kinematics::Machine& machine,
                                      const calibration::StepDesign& design);

}  // namespace frustum::app
