// A choice of step patterns for people and for programs.
// Units: um and urad. Errors: none.
#pragma once

#include <string>

#include "calibration/step_catalogue.hpp"
#include "kinematics/machine.hpp"

namespace frustum::app {

struct Design {
  calibration::StepCatalogue catalogue{};
  calibration::DesignResult result{};
  std::vector<std::optional<double>> limits{};  // of standard deviations, one an unknown
  std::vector<std::string> left_out{};          // unknowns that no pattern tells from the others
  // What all patterns together cannot tell, in words.
  std::vector<calibration::NullDirection> null_space{};
};

[[nodiscard]] std::string design_text(const kinematics::Machine& machine, const Design& design);
[[nodiscard]] std::string design_json(const kinematics::Machine& machine, const Design& design);

}  // namespace frustum::app
