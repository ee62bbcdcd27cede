// Tools that programs call and that nobody has measured.
//
// Units: mm. Errors: none.
#pragma once

#include <initializer_list>
#include <set>
#include <span>

#include "kinematics/controller/setup.hpp"
#include "parser/motion.hpp"

namespace frustum::app {

inline constexpr double kAssumedToolLength = 100.0;  // mm, of tools that nobody gave a length

// Tools and lengths that the programs call and that the set-up does not have.
[[nodiscard]] std::set<int> unmeasured_tools(
    const kinematics::Setup& setup,
    std::initializer_list<std::span<const parser::Motion>> programs);

}  // namespace frustum::app
