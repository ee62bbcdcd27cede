// Faults that programs have, each with what it looks like in words and how it is undone.
//
// Units  : mm, rad
// Errors : none
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "kinematics/model/machine.hpp"
#include "parser/motion.hpp"

namespace frustum::post {

struct Fault {
  std::string words{};
  // The motions as they would be without the fault.
  std::function<std::vector<parser::Motion>(const std::vector<parser::Motion>&)> undo{};
};

// Faults of signs, units, modes and swapped words that make sense on this machine.
[[nodiscard]] std::vector<Fault> known_faults(const kinematics::Machine& machine);

// A rotary axis whose zero is elsewhere by `offset` rad.
[[nodiscard]] Fault shifted_rotary_axis(parser::AxisLetter axis, double offset);

}  // namespace frustum::post
