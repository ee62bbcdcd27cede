// A measurement as JUnit XML, so that continuous integration shows each characteristic as a test.
//
// One testsuite, named by the title; one testcase a characteristic, classname the title. A
// characteristic out of tolerance is a failure with value, tolerance and uncertainty; one of
// the plan that was not measured is an error with the reason. Faults that belong to no
// characteristic (a collision, a diagnostic) are a testcase "run" with an error.
// Units  : as the text says; every time is 0, since one measurement makes all characteristics
// Errors : none
#pragma once

#include <string>

#include "metrology/plan/inspection_plan.hpp"
#include "report/run_report.hpp"

namespace frustum::report {

[[nodiscard]] std::string junit_report(const RunReport& report,
                                       const metrology::InspectionPlan& plan);

}  // namespace frustum::report
