// A measurement as a QIF 3.0 results document (ISO 23952).
//
// Every feature of the plan with definition, nominal, item and measurement, the points of each, and
// every characteristic with definition, nominal, item, measurement and verdict; aspects refer to
// one another by id. The order of elements is that of the schema; lists state their length in n.
// What QIF has no elements for of the plan is in attributes (qif_plan_keys.hpp), so that results
// are a plan too. The document's identifier (QPId) is made from its content, so that the same
// measurement gives the same file to the last bit.
// Units  : mm and deg, as FileUnits states; coordinates in the datum frame, where the plan's
//          nominals are
// Errors : none; see qif_features.hpp and qif_characteristics.hpp for what QIF cannot hold
// Source : ISO 23952:2020; ISO 1101:2017 is named as the standard of the characteristics
#pragma once

#include <string>

#include "metrology/plan/inspection_plan.hpp"
#include "report/run_report.hpp"

namespace frustum::report {

[[nodiscard]] std::string qif_results(const RunReport& report,
                                      const metrology::InspectionPlan& plan);

// The plan alone, for who measures. A ruled surface has no element in QIF and is left out.
[[nodiscard]] std::string qif_plan(const metrology::InspectionPlan& plan);

}  // namespace frustum::report
