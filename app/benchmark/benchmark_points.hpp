// Points that a CMM measured, as deviations at the points that the plan asks for.
//
// Model  : a measured point belongs to the planned point of its feature that is nearest, in
//          whatever order the file has them; its deviation is along the planned normal
// Units  : um
// Shape  : one for each planned point, features and points in the plan's order; nothing: not
//          measured
// Errors : those of point files; a feature that the plan does not have, a point that is 1 mm or
//          more from all that are planned, two at one planned point: each with file and line
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/result.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::app {

[[nodiscard]] Result<std::vector<std::optional<double>>> planned_deviations(
    const metrology::InspectionPlan& plan, const std::filesystem::path& file);

}  // namespace frustum::app
