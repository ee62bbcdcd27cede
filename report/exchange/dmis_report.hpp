// Results as a DMIS output file: what a program with OUTPUT statements writes on a CMM.
//
// Model  : for each feature OUTPUT, F() as planned and FA() as measured, with T() and TA() of its
//          characteristics; its points as FEAT/POINT features of their own; datums as DATDEF.
//          Forms, orientations, positions and run-outs have the value in TA(), sizes the deviation
//          from nominal. What DMIS has no word for (the form of a cone, distances and angles of
//          lines) is a comment
// Units  : mm, degrees (UNITS/MM,ANGDEC); a cone has its full angle and its apex
// Errors : none; labels are put into letters, digits and _, and are unique
// Source : the statements of DMIS 5.3 (ISO 22093), laid out as the results file that the
//          Digital Metrology Standards Consortium makes from QIF (github.com/
//          QualityInformationFramework/qif-community)
#pragma once

#include <string>

#include "metrology/plan/inspection_plan.hpp"
#include "report/run_report.hpp"

namespace frustum::report {

[[nodiscard]] std::string dmis_report(const RunReport& report,
                                      const metrology::InspectionPlan& plan);

}  // namespace frustum::report
