// How a part was measured, in words: machine and its accuracy, probe, alignment, filters,
// associations, uncertainty, decision rule.
//
// Facts for files are in English and mm, those of a page as its wording says.
// Units: as printed beside each number. Errors: none.
// Source: ISO 10360-2 for E, ISO 14253-1 for the decision rule, JCGM 100 for U
#pragma once

#include <vector>

#include "metrology/plan/inspection_plan.hpp"
#include "metrology/probing/cmm_model.hpp"
#include "report/evidence.hpp"
#include "report/wording.hpp"

namespace frustum::report {

// Where the points come from.
enum class PointSource { virtual_cmm, mesh, measured_points };

// Facts with the keys source, accuracy, probe, stylus, temperature, alignment, filter, association,
// parameter, uncertainty, decision_rule; those of which nothing is known or that do not apply are
// left out.
[[nodiscard]] std::vector<Fact> measuring_statement(const metrology::InspectionPlan& plan,
                                                    const metrology::CmmModel& cmm,
                                                    PointSource source,
                                                    const Wording& words = Wording());

}  // namespace frustum::report
