// The setup sheet of a step pattern piece.
// Units: mm, rad. Errors: none.
#pragma once

#include "kinematics/machine.hpp"
#include "programs/step_pattern.hpp"
#include "report/setup_sheet.hpp"

namespace frustum::app {

[[nodiscard]] report::SetupSheet sheet_of(const programs::StepTest& test,
                                          const programs::StepPiece& piece,
                                          const kinematics::Machine& machine);

}  // namespace frustum::app
