// An inspection plan as a file in the form that its extension names: .qif or .toml.
//
// Units  : as each form says
// Errors : another extension; a feature that QIF has no element for; a place that cannot be written
//          to
#pragma once

#include <filesystem>

#include "core/diagnostic.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::app {

// Folders on the way are made.
[[nodiscard]] Diagnostics write_plan(const std::filesystem::path& file,
                                     const metrology::InspectionPlan& plan);

}  // namespace frustum::app
