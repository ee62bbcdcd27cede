// Axis positions as they are written on the command line: "X=10,Y=0,A=-30".
// Units: mm and degrees in the text, mm and rad in the result.
// Errors: an axis that the machine lacks, one given twice, text that is no number.
#pragma once

#include <map>
#include <string>

#include "core/result.hpp"
#include "kinematics/model/machine.hpp"

namespace frustum::app {

using AxisWords = std::map<kinematics::AxisLetter, double>;

[[nodiscard]] Result<AxisWords> read_axis_words(const kinematics::Machine& machine,
                                                const std::string& text);

}  // namespace frustum::app
