// A drawing of a machine's bodies where its axes are at home.
//
// Units: pixels. Errors: none; machines whose bodies are meshes are not drawn.
#pragma once

#include <string>

#include "kinematics/model/machine.hpp"

namespace frustum::stock {

// A whole SVG file. The viewer is above the machine, `azimuth` (rad) from its X towards its Y.
[[nodiscard]] std::string machine_drawing(const kinematics::Machine& machine, double azimuth);

}  // namespace frustum::stock
