// The form of output that a program needs: the tip's words only where an axis turns. Where none
// does, positions of X Y Z are the tip's, and every control reads them.
//
// Units : none
// Errors: none
#pragma once

#include <span>

#include "kinematics/model/machine.hpp"
#include "parser/motion.hpp"
#include "post/planning/machine_program.hpp"

namespace frustum::post {

[[nodiscard]] PlanOptions with_fitting_form(const kinematics::Machine& machine,
                                            std::span<const parser::Motion> motions,
                                            PlanOptions options);

}  // namespace frustum::post
