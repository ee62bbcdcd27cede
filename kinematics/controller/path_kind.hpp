// Whether a move cuts, and how the spindle turns meanwhile.
//
// Units : none
// Errors: none
#pragma once

#include <cstdint>

#include "parser/motion.hpp"

namespace frustum::kinematics {

using parser::SpindleDirection;

enum class PathKind : std::uint8_t { rapid, feed };

}  // namespace frustum::kinematics
