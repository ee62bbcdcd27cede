// Where a program that places a work offset itself (G10 L2) puts its origin.
//
// Units : mm
// Errors: none; no value where the program leaves out an axis that nothing else gives
#pragma once

#include <optional>

#include "kinematics/model/machine.hpp"
#include "parser/motion.hpp"

namespace frustum::kinematics {

// In the table frame; `before` is the origin that the setup or the program gave so far.
[[nodiscard]] std::optional<Vec3> placed_origin(const Machine& machine,
                                                const parser::WorkOffsetSetting& setting,
                                                const std::optional<Vec3>& before);

}  // namespace frustum::kinematics
