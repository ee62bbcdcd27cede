// All characteristics of a plan, each in its frame: the datum system's, or one of its own.
//
// Model    : workpiece_from_datum = frame of the measured datum elements times the inverse of the
//            frame of the nominal ones, so it is the identity for a perfect part
// Units    : mm, rad
// Shape    : all features of a plan
// Errors   : those of datum_system.hpp and characteristic.hpp; a datum feature without points
// Accuracy : that of the fits
// Source   : Bossoni 2010, appendix A.4
#pragma once

#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"

namespace frustum::metrology {

// `features` are in the workpiece frame. Without uncertainties and rules of decision.
[[nodiscard]] Result<Measurement> evaluated_values(const InspectionPlan& plan,
                                                   std::vector<FittedFeature> features);

}  // namespace frustum::metrology
