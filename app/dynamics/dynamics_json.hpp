// The answer of frustum dynamics for programs, with names that stay.
//
// Units  : as the names say: mm, um, Hz, N, rad; inertial compliance um/gn of linear axes and
//          um/(rad/s^2) of rotary ones, tracking deviation m per m or rad
// Errors : none
#pragma once

#include <string>
#include <vector>

#include "app/dynamics/dynamics_answer.hpp"
#include "dynamics/identification.hpp"

namespace frustum::app {

struct ComparedMachine {
  std::string name{};
  std::vector<ComparedRow> rows{};
};

// Without another machine, or measured responses, nothing is compared, nothing identified.
struct DynamicsReport {
  const kinematics::Machine& machine;
  const dynamics::DynamicModel& model;
  const DynamicsRequest& request;
  const DynamicsAnswer& answer;
  std::size_t modes = 0;  // and poles: that many are listed at most
  const std::optional<ComparedMachine>& compared;
  const std::optional<dynamics::Identification>& identified;
};

[[nodiscard]] std::string dynamics_json(const DynamicsReport& report);

}  // namespace frustum::app
