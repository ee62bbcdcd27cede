// ISO 10791 structure codes: "t-(C)-Z-Y-b-X-B-C-w".
//
// Errors: axis twice, missing t, b or w, unknown letters, more than two rotary axes, not X Y Z.
#pragma once

#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "kinematics/model/axes.hpp"

namespace frustum::kinematics {

// Axes of both chains, from the bed outwards.
struct StructureCode {
  std::vector<AxisLetter> tool{};
  std::vector<AxisLetter> work{};
};

[[nodiscard]] Result<StructureCode> parse_structure(std::string_view code);

}  // namespace frustum::kinematics
