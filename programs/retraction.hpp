// Where programs lift the tool to: the home position of Z.
//
// Units : mm, machine coordinates
// Errors: none; a doubt is a warning
#pragma once

#include <optional>

#include "core/diagnostic.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::programs {

// Where the home of Z is not in the upper half of its travel: a tool that goes there is not clear
// of the part.
[[nodiscard]] std::optional<Diagnostic> doubt_of_retraction(const kinematics::Machine& machine);

}  // namespace frustum::programs
