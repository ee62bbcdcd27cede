// The setup sheet of a step pattern piece.
// Units: mm, rad. Errors: none.
#pragma once

#include "kinematics/model/machine.hpp"
#include "programs/step/step_pattern.hpp"
#include "report/sheet/setup_sheet.hpp"

namespace frustum::app {

[[nodiscard]] report::SetupSheet sheet_of(const programs::StepTest& test,
                                          const programs::StepPiece& piece,
                                          const kinematics::Machine& machine);

}  // namespace frustum::app
