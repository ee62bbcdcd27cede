// Shipped machines for tests.
#pragma once

#include <cstdlib>
#include <string>

#include "kinematics/machine.hpp"

namespace frustum::kinematics {

inline Machine shipped(const std::string& name) {
  auto machine = Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  if (!machine) std::abort();
  return *std::move(machine);
}

}  // namespace frustum::kinematics
