// Whether a move cuts.
//
// Units : none
// Errors: none
#pragma once

#include <cstdint>

namespace frustum::kinematics {

enum class PathKind : std::uint8_t { rapid, feed };

}  // namespace frustum::kinematics
