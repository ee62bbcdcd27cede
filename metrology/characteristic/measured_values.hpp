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

#include <functional>
#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/probing/cmm_model.hpp"

namespace frustum::metrology {

// Standard, mm or rad, of a characteristic that compares lines.
using LineUncertainty = std::function<double(const PlannedCharacteristic&)>;

// `features` are in the workpiece frame. Without simulated uncertainties and rules of decision.
[[nodiscard]] Result<Measurement> evaluated_values(const InspectionPlan& plan,
                                                   std::vector<FittedFeature> features,
                                                   const CmmModel& cmm,
                                                   const LineUncertainty& line_uncertainty = {});

}  // namespace frustum::metrology
