// From fitted features to the numbers on a drawing.
//
// Model    : see CharacteristicKind (inspection_plan.hpp); evaluators.hpp says where each is
//            evaluated
// Units    : mm, rad inside; a CharacteristicResult is in its own unit: um for forms and zones, deg
//            for half angles, mm for radii and diameters, um and urad for lines
// Shape    : one characteristic a call
// Errors   : a section with too few or degenerate points; each names the characteristic
// Accuracy : 1e-9 mm (tests/metrology/characteristic_test.cpp)
// Source   : Bossoni 2010, section 3.9 (equivalent cone form)
#pragma once

#include <span>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/characteristic/round_profile.hpp"
#include "metrology/measurement.hpp"

namespace frustum::metrology {

// `features` are all that were measured, in the frame in which the plan holds: that of its datum
// system, or without one the workpiece's. Concentricity within one feature looks along its planned
// axis (its own fitted axis runs through any two of its sections and would hide what is asked). How
// far it can be trusted depends on frames and datum systems, too: uncertainty/.
[[nodiscard]] Result<CharacteristicResult> evaluate(const PlannedCharacteristic& planned,
                                                    std::span<const FittedFeature> features);
// The same where it is known which those are that it names, in its order.
[[nodiscard]] Result<CharacteristicResult> evaluate(const PlannedCharacteristic& planned,
                                                    std::vector<const FittedFeature*> named);
[[nodiscard]] Diagnostic without_points(const PlannedCharacteristic& planned,
                                        const std::string& feature);

}  // namespace frustum::metrology
