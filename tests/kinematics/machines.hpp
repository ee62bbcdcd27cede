// Shipped machines for tests.
#pragma once

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "kinematics/model/machine.hpp"

namespace frustum::kinematics {

inline Machine shipped(const std::string& name) {
  auto machine = Machine::load(std::string(FRUSTUM_SOURCE_DIR) + "/machines/" + name + ".toml");
  if (!machine) std::abort();
  return *std::move(machine);
}

// A machine from the text of its file.
inline Result<Machine> machine_from_text(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() /
                    ("frustum-machine-" + std::to_string(::getpid()) + ".toml");
  std::ofstream(file) << text;
  auto machine = Machine::load(file);
  std::filesystem::remove(file);
  return machine;
}

}  // namespace frustum::kinematics
