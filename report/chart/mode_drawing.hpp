// A mode of a machine: its bodies as boxes that swing about their places.
//
// Units: mm; frame of the machine, seen from the front right and above. Errors: none.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/pose.hpp"

namespace frustum::report {

struct SwingingBody {
  std::string name{};
  std::array<Vec3, 8> corners{};  // x fastest, then y, then z
  std::array<Vec3, 8> swing{};    // displacement of each at the end of the swing
};

struct ModeDrawing {
  std::string title{};
  std::vector<SwingingBody> bodies{};  // the bed first
};

[[nodiscard]] std::string mode_figure(const ModeDrawing& mode);

}  // namespace frustum::report
