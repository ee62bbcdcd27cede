// Measured characteristics of a part: typed in from a report, or the result of a run.
//
// Units: mm and rad inside; in files each value carries its unit.
// Errors: file, key and what was expected; a value without unit, a length where an angle belongs.
#pragma once

#include <filesystem>

#include "app/job/study.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::app {

// By its extension: .toml  [measured] "1-a.dL" = "-24.6 um" or { value = .., uncertainty = .. };
// .json the result of `frustum run` or `measure`; .csv points of a CMM, evaluated by the plan.
[[nodiscard]] Result<MeasuredPart> read_measured_part(const std::filesystem::path& file,
                                                      const metrology::InspectionPlan& plan);

}  // namespace frustum::app
