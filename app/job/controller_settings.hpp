// The [controller] table of a job: how the machine's control moves its axes.
//
// Units: s; mm/s and deg/s for the rapids, mm and deg for renewals, as in machine files
// Errors: noted in the document, by key
#pragma once

#include "core/toml_document.hpp"
#include "dynamics/path_deviation.hpp"
#include "kinematics/timing/time_law.hpp"

namespace frustum::app {

struct ControllerSettings {
  kinematics::TimeLawOptions time_law{};
  bool servo_lag = false;
  dynamics::PathDynamics dynamics{};
};

[[nodiscard]] ControllerSettings read_controller(const TomlTable& job);

}  // namespace frustum::app
