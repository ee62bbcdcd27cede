// Joint covariance of the characteristics of one measurement, from the accuracy of a CMM.
//
// Model    : the errors that cmm.hpp simulates, propagated as linear_uncertainty.hpp does: every
//            point has the standard deviation e0/2 along its normal; the machine's linear field has
//            six terms of standard deviation 1/(2 k), common to all points. Characteristics that
//            share points, a frame or long distances are correlated. Forms, zones and
//            concentricities, which have no derivative at zero, keep the variance of their stated
//            uncertainty (linear_uncertainty.hpp) and count as uncorrelated
// Units    : rows and columns in mm or rad, as the characteristic is a length or an angle
// Shape    : as many rows and columns as measurement.characteristics, in that order
// Errors   : a measurement that is not one of this plan; features without points
// Accuracy : variances within 10 %, correlations within 0.08 of 2000 simulated measurements
//            (tests/metrology/propagation_test.cpp)
// Source   : JCGM 102:2011, section 6.2
#pragma once

#include <Eigen/Core>

#include "core/result.hpp"
#include "metrology/measurement.hpp"
#include "metrology/plan/inspection_plan.hpp"
#include "metrology/probing/cmm_model.hpp"

namespace frustum::metrology {

[[nodiscard]] Result<Eigen::MatrixXd> covariance(const InspectionPlan& plan,
                                                 const Measurement& measurement,
                                                 const CmmModel& cmm);

}  // namespace frustum::metrology
