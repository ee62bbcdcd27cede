// The road both kinds of points take, from the virtual CMM and from real ones: fits, datum frame,
// characteristics.
//
// Model    : workpiece_from_datum = frame of the measured datum elements times the inverse of the
//            frame of the nominal ones, so it is the identity for a perfect part
// Units    : mm, rad
// Shape    : all features of a plan
// Errors   : those of datum_system.hpp and characteristic.hpp; a datum feature without points
// Accuracy : that of the fits
// Source   : Bossoni 2010, appendix A.4
#pragma once

#include <span>
#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/cmm.hpp"

namespace frustum::metrology {

// True when results of this plan refer to measured datum features.
[[nodiscard]] bool uses_datum(const InspectionPlan& plan);
[[nodiscard]] bool is_datum_feature(const InspectionPlan& plan, const PlannedFeature& feature);

// workpiece_from_datum; the identity for a plan without datum system.
[[nodiscard]] Result<Pose> alignment_of(const InspectionPlan& plan,
                                        std::span<const FittedFeature> features);

// `features` are in the workpiece frame. With uncertainties by simulation and verdicts by the rule that the
// plan asks for.
[[nodiscard]] Result<Measurement> evaluated(const InspectionPlan& plan,
                                            std::vector<FittedFeature> features,
                                            const CmmModel& cmm);
// Without them.
[[nodiscard]] Result<Measurement> evaluated_values(const InspectionPlan& plan,
                                                   std::vector<FittedFeature> features,
                                                   const CmmModel& cmm);

}  // namespace frustum::metrology
