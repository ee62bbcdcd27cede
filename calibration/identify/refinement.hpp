// Identification with a model that is not linear: rerun it at the estimate until the estimate
// stays.
//
// Model    : Gauss-Newton; at x the measurements are linear, y - f(x) + G x = G x_next
// Units    : mm, rad
// Shape    : the model answers all unknowns (fixed ones included) with rows and rows x unknowns
// Errors   : those of identify and of the model; a prediction of another size or not finite; no
//            rest after `most_rounds`, with the unknown that moved most
// Accuracy : the last change of every unknown is below `settled` of its standard uncertainty
// Source   : Nocedal, Wright, Numerical Optimization, section 10.3
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "calibration/identify/identification.hpp"
#include "core/result.hpp"

namespace frustum::calibration {

struct Prediction {
  Eigen::VectorXd values{};  // of the rows
  Eigen::MatrixXd gain{};    // rows x unknowns, at the same place
};
using Model = std::function<Result<Prediction>(const Eigen::VectorXd& unknowns)>;

struct RefineOptions {
  IdentifyOptions identify{};
  int most_rounds = 12;
  double settled = 1e-3;  // of the standard uncertainty
};

struct Refinement {
  Identification identification{};
  // Largest change of an unknown in each round, in standard uncertainties; the first is from the
  // start.
  std::vector<double> changes{};
};

// `observations.gain` is not used. Starts at the fixed and known values, zero elsewhere.
[[nodiscard]] Result<Refinement> refine(Observations observations, const Model& model,
                                        const RefineOptions& options = {});

}  // namespace frustum::calibration
