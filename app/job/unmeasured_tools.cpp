#include "app/job/unmeasured_tools.hpp"

namespace frustum::app {

std::set<int> unmeasured_tools(const kinematics::Setup& setup,
                               std::initializer_list<std::span<const parser::Motion>> programs) {
  std::set<int> tools;
  for (const auto& motions : programs) {
    for (const parser::Motion& motion : motions) {
      int number = -1;
      if (const auto* change = std::get_if<parser::ToolChange>(&motion.command)) {
        if (change->tool > 0) number = change->tool;
      } else if (const auto* length = std::get_if<parser::CompensationChange>(&motion.command)) {
        const bool off = length->mode == parser::LengthCompensation::off || length->length;
        if (!off) number = length->offset_number;
      }
      if (number >= 0 && !setup.tools.contains(number)) tools.insert(number);
    }
  }
  return tools;
}

}  // namespace frustum::app
