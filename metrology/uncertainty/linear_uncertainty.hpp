// Standard uncertainties of all characteristics of a measurement by linear propagation: one
// mechanism for every kind, with every datum and lever arm in it.
//
// Model    : the points of a feature err independently along their normals. What they do to its
//            element goes by a few patterns, those of the element's own changes (a plane lifts and
//            tilts, ...): orthonormal patterns of n points have independent coefficients of one
//            point's variance. Each is laid over the measured points, either way, and everything is
//            fitted and evaluated again, datum systems and frames too; so is each term of the
//            machine's linear field. What is left of a point or of a section's centre beside its
//            element is its own (NonNegative::own). A value of either sign has the variance of its
//            responses and lies within twice its root of the truth; a size has the variance and
//            bounds of part_noise.hpp. Elements that touch single points (om, mi, mc) answer to
//            those alone, and to others when the errors are larger: what depends on one has the
//            root mean square of 256 draws instead. A form that is filtered, touched, or another
//            parameter than the peak to valley has the deviation that small errors give it, and is
//            above the truth by what errors make of a perfect feature at most
// Units    : mm, rad
// Shape    : all characteristics of a plan, in its order
// Errors   : those of the fits and evaluations
// Accuracy : first order about the measured part (1e-7 of what each point does by itself,
//            tests/metrology/propagation_test.cpp); on the safe side for forms, whose points share
//            in the fit
// Source   : JCGM 100:2008, section 5.1.2
#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "core/result.hpp"
#include "metrology/characteristic/fitted_feature.hpp"
#include "metrology/uncertainty/part_noise.hpp"
#include "metrology/uncertainty/point_uncertainty.hpp"

namespace frustum::metrology {

struct LinearUncertainty {
  std::vector<double> standard{};
  std::vector<TruthBounds> bounds{};  // 95 % of measurements or more are within
  // Not of what rests on single points that an element touches: which points these are may be
  // another thing of the measured part than of the part.
  std::vector<bool> is_proven{};
  // What independent errors of one standard deviation do to the values of either sign: a row a
  // characteristic, zeros for the others. The joint covariance is this times its transpose.
  Eigen::SparseMatrix<double, Eigen::RowMajor> answers{};
};

// Whether `is_proven` holds of a characteristic of the plan.
[[nodiscard]] bool is_coverage_proven(const InspectionPlan& plan,
                                      const PlannedCharacteristic& characteristic);

// `features` as measured, in the workpiece frame.
[[nodiscard]] Result<LinearUncertainty> linear_uncertainty(const InspectionPlan& plan,
                                                           std::span<const FittedFeature> features,
                                                           const PointUncertainty& u);

}  // namespace frustum::metrology
