// The answer of frustum dynamics on a terminal.
// Units: as the headings say. Errors: none.
#pragma once

#include <string>

#include "app/dynamics/dynamics_json.hpp"

namespace frustum::app {

[[nodiscard]] std::string dynamics_text(const kinematics::Machine& machine,
                                        const dynamics::DynamicModel& model,
                                        const DynamicsRequest& request,
                                        const DynamicsAnswer& answer, std::size_t modes,
                                        const std::optional<ComparedMachine>& compared,
                                        const std::optional<dynamics::Identification>& identified);

}  // namespace frustum::app
