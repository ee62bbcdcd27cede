// The tools that a control knows: numbers, offsets, diameters, as far as a program depends on them.
//
// Units : mm, rad
// Errors: none
#pragma once

#include <array>
#include <map>
#include <string>

#include "parser/motion.hpp"

namespace frustum::parser {

struct Tool {
  int pocket = 0;
  std::array<double, kAxisLetters.size()>
      offset{};  // of its tip from the gauge point, along the machine axes
  double diameter = 0.0;
  std::string remark{};
};

using ToolTable = std::map<int, Tool>;  // by tool number

}  // namespace frustum::parser
