// The characteristics as CSV, one line each.
//
// Columns: name,kind,features,value,nominal,deviation,tolerance,expanded_uncertainty,unit,verdict,
// interval_low,interval_high,coverage; several features are separated by blanks; the kind of a form
// whose plan states a parameter has it after it ("roundness RONp"). Units: value to
// expanded_uncertainty and interval in `unit` (um, mm, deg, urad), all digits, never an exponent;
// coverage says how often they hold the true value. Errors: none; a number that is not finite is
// left empty, a characteristic without nominal and an uncertainty of which nothing is known too.
#pragma once

#include <string>

#include "metrology/measurement.hpp"
#include "metrology/plan/inspection_plan.hpp"

namespace frustum::report {

[[nodiscard]] std::string characteristics_csv(const metrology::Measurement& measurement,
                                              const metrology::InspectionPlan& plan);

}  // namespace frustum::report
