// "Made by Frustum 0.1.0": what files say that have a place for it.
//
// Units  : none
// Errors : none
#pragma once

#include <string>

#include "core/program_version.hpp"

namespace frustum {

[[nodiscard]] inline std::string made_by() {
  return "Made by Frustum " + std::string(program_version());
}

}  // namespace frustum
