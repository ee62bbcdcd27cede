// Machine errors from measured characteristics, with what the measurements do not say.
//
// Model    : generalised least squares, minimum of |matrix z - right|^2 of the weighted system by
//            singular values; directions of the null space are left out
//            covariance C = size V S^-2 V^T size; residual covariance Q = S - A C A^T
//            w_i = (S^+ e)_i / sqrt((S^+ Q S^+)_ii); normalised residual e_i / sqrt(Q_ii)
//            Birge = sqrt(chi2 / degrees of freedom)
// Units    : mm, rad
// Shape    : any number of rows and unknowns; one Estimate an unknown, in their order
// Errors   : those of weighted_system; confidence outside (0, 1)
// Accuracy : the joint fit of the eleven step patterns to 1e-4 urad, 1e-5 um
//            (tests/calibration/step_identification_test.cpp)
// Source   : JCGM 102:2011; Baarda 1968, A testing procedure for use in geodetic networks (w-test);
//            Birge 1932, Phys. Rev. 40, 207
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "calibration/identify/observability.hpp"
#include "calibration/identify/observations.hpp"
#include "calibration/identify/weighted_system.hpp"
#include "core/result.hpp"

namespace frustum::calibration {

// A right model is rejected once in a hundred cases.
constexpr double kRejection = 0.01;
constexpr double kOutlier = 3.0;
// Baarda's limit of the w-test: the normal deviate that one right measurement in a thousand
// exceeds.
constexpr double kSnooping = 3.2905;
// Rows that ought to be the same (without noise between them) may differ by this part of their
// standard deviation, for rounding in the report.
constexpr double kContradiction = 0.1;

struct IdentifyOptions {
  Floor floor{};
  double confidence = 0.95;
  // Of the covariance, where it was estimated from repeated parts: the intervals are Student's.
  // Without it the covariance counts as known and they are normal.
  std::optional<double> degrees_of_freedom{};
};

// Value and interval are empty where the null space touches the unknown.
struct Estimate {
  std::string name{};
  bool angular = false;
  bool fixed = false;
  std::optional<double> value{};
  std::optional<double> standard_uncertainty{};
  std::optional<double> lower{};
  std::optional<double> upper{};
};

struct EstimatedCombination {
  Combination combination{};
  double value = 0.0;
  double standard_uncertainty = 0.0;
  double lower = 0.0;
  double upper = 0.0;
};

// A measured row, or a prior ("prior beta_ZX").
struct Residual {
  std::string name{};
  bool angular = false;
  bool prior = false;
  double measured = 0.0;
  double predicted = 0.0;
  double residual = 0.0;  // measured - predicted
  // Empty where nothing else checks the row.
  std::optional<double> normalised{};
  std::optional<double> w{};
  bool outlier = false;  // |normalised| above kOutlier
};

struct Agreement {
  double chi_square = 0.0;
  int degrees_of_freedom = 0;
  // Empty without degrees of freedom. The Birge factor is for the reader: nothing is multiplied by
  // it.
  std::optional<double> probability{};
  std::optional<double> birge{};
  bool rejected = false;  // probability below kRejection: the model does not explain the data
};

struct Identification {
  std::vector<Estimate> estimates{};
  // Of all unknowns; zero in the rows of fixed ones and of those without an estimate.
  Eigen::MatrixXd covariance{};
  // Unknowns at which a model can be evaluated: estimates and fixed values; those that cannot be
  // identified make the smallest change (in expected sizes) that explains the data and mean nothing
  // alone.
  Eigen::VectorXd working_point{};
  std::vector<EstimatedCombination> combinations{};
  std::vector<Residual> residuals{};  // rows, then priors
  Agreement agreement{};
  Observability observability{};
  // Data snooping: the row with the largest |w|, when above kSnooping.
  std::optional<std::size_t> suspect{};
  // What the reader has to know, in words: null space, contradictions, verdict, suspect.
  Diagnostics diagnostics{};
};

[[nodiscard]] Result<Identification> identify(const Observations& observations,
                                              const IdentifyOptions& options = {});

}  // namespace frustum::calibration
