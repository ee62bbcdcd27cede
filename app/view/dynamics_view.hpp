// The answer of frustum dynamics on a terminal.
// Units: as the headings say. Errors: none.
#pragma once

#include <string>

#include "app/dynamics/dynamics_json.hpp"

namespace frustum::app {

[[nodiscard]] std::string dynamics_text(const DynamicsReport& report);

}  // namespace frustum::app
