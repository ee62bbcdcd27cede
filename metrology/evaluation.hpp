// What both kinds of points take, those of the virtual CMM and real ones: characteristics of fitted
// features, their uncertainties, verdicts.
//
// Model    : measured_values.hpp, linear_uncertainty.hpp, monte_carlo_uncertainty.hpp and
//            decision_rule.hpp in turn
// Units    : mm, rad
// Shape    : all features of a plan
// Errors   : those of datum_system.hpp and characteristic.hpp; a datum feature without points
// Accuracy : that of the fits
// Source   : Bossoni 2010, appendix A.4
#pragma once

#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/measured_values.hpp"
#include "metrology/probing/cmm_model.hpp"

namespace frustum::metrology {

// `features` are in the workpiece frame. With uncertainties by simulation and verdicts by the rule
// that the plan asks for.
[[nodiscard]] Result<Measurement> evaluated(const InspectionPlan& plan,
                                            std::vector<FittedFeature> features,
                                            const CmmModel& cmm, NoErrors mean = NoErrors::ideal);

}  // namespace frustum::metrology
