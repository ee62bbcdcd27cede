// Why two programs part: known faults are undone in the second program, one at a time, and the one
// that makes it agree with the first is named.
//
// Model    : faults of signs, units, modes and swapped words are undone in the motions. Lengths and
//            positions (tool length, work offset, place of a rotary axis) are fitted: the
//            displacement of the second path across the first one's direction is linear in them, so
//            that a few Gauss-Newton steps find the amount. A cause is named only if the whole
//            program then agrees
// Units    : mm, rad
// Errors   : none; an empty text when no single cause explains the difference
#pragma once

#include <string>

#include "kinematics/controller/commanded_program.hpp"
#include "post/comparing/path_difference.hpp"

namespace frustum::post {

[[nodiscard]] std::string likely_cause(const kinematics::Machine& machine,
                                       const kinematics::ToolPath& first,
                                       const kinematics::ToolPath& second,
                                       const ComparedProgram& second_program,
                                       const kinematics::CommandedProgram& second_commanded,
                                       const PathDifference& difference,
                                       const DifferenceLimits& limits);

}  // namespace frustum::post
