// A choice of step patterns for people and for programs.
// Units: um and urad. Errors: none.
#pragma once

#include <string>
#include <vector>

#include "calibration/design/step_design.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::app {

// `exact`: errors taken as exactly known; `limited`: standard deviations were asked for.
[[nodiscard]] std::string design_text(const kinematics::Machine& machine,
                                      const calibration::StepDesign& design,
                                      const std::vector<std::string>& exact, bool limited);
[[nodiscard]] std::string design_json(const kinematics::Machine& machine,
                                      const calibration::StepDesign& design,
                                      const std::vector<std::string>& exact);

}  // namespace frustum::app
