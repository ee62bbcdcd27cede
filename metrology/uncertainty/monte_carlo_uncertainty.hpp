// Uncertainties of all characteristics of a measurement by simulating it many times.
//
// Model    : every draw moves the measured ball centres by errors of the CMM, fits all features
//            again from their known elements and evaluates the whole plan: frames, datum system,
//            characteristics. A value of either sign gets the interval between the 2.5 % and 97.5 %
//            quantiles of its draws; a non-negative measurand that of non_negative_interval.hpp,
//            whose noise is how its parts move from draw to draw. Blocks of 2,000 draws are added,
//            five at least, until twice the standard error of the block means of the standard
//            uncertainty and of both ends is below half a unit of the last of `digits` digits of
//            the standard uncertainty, for every characteristic
// Units    : mm, rad; results in the units of their characteristics
// Shape    : all characteristics of a plan
// Errors   : a draw whose points no longer tell an element
// Accuracy : coverage 93 % to 97 % (tests/metrology/coverage_test.cpp); results with digits = 1 to
//            half a digit of u. Draws are pure functions of seed and number, added in order
// Source   : JCGM 101:2008, sections 5 and 7.9 (blocks of 100/(1 - p) draws instead of 10,000)
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/plan/monte_carlo_settings.hpp"
#include "metrology/probing/cmm_model.hpp"

namespace frustum::metrology {

// Where a measurement sees a ball centre: centre (workpiece frame), approach (outward normal),
// feature and point of the plan.
using MeasuringErrors = std::function<Vec3(const Vec3& centre, const Vec3& approach,
                                           std::size_t feature, std::size_t point)>;
// The errors of one measurement; another one for each draw.
using ErrorDraws = std::function<MeasuringErrors(std::uint32_t draw)>;

// Noise e0/2 along the approach and one linear field a draw, as cmm.hpp; none of the draws is the
// measurement that the seed of the model itself makes.
[[nodiscard]] ErrorDraws error_draws(const CmmModel& cmm, std::uint64_t seed);

// The features with the errors of one draw in their points, fitted again. `features` as measured,
// in the workpiece frame.
[[nodiscard]] Result<std::vector<FittedFeature>> remeasured_features(
    const InspectionPlan& plan, std::span<const FittedFeature> features,
    const MeasuringErrors& errors);
// The measurement that they give.
[[nodiscard]] Result<Measurement> remeasured(const InspectionPlan& plan,
                                             std::span<const FittedFeature> features,
                                             const MeasuringErrors& errors);

// One a characteristic, in the order of the plan.
[[nodiscard]] Result<std::vector<SimulatedUncertainty>> simulated_uncertainties(
    const InspectionPlan& plan, std::span<const FittedFeature> features, const ErrorDraws& draws,
    const MonteCarloSettings& settings);

}  // namespace frustum::metrology
