// Measured test pieces as observations of the errors that made them.
//
// Model    : rows of all pieces one after the other; several parts of one piece are pooled
//            (repeatability.hpp); a row's variance is the stated one, else that of the measuring
//            machine propagated through the plan (metrology/uncertainty/propagation.hpp), whose
//            correlations are kept between rows without a stated one
// Units    : mm, rad
// Shape    : rows: the measured characteristics of each piece; columns: the unknowns
// Errors   : those of the trials; nothing but forms and zones measured; a characteristic that the
//            plan lacks or that is measured on some parts only; a row with neither a stated
//            uncertainty nor a measuring machine
// Accuracy : that of trials::sensitivity() and metrology::covariance()
// Source   : ours
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "calibration/identify/trial_model.hpp"
#include "metrology/cmm.hpp"

namespace frustum::calibration {

struct MeasuredValue {
  double value = 0.0;                   // mm or rad
  std::optional<double> uncertainty{};  // standard; absent: the measuring machine's
};
// One measured part, by characteristic.
using MeasuredPart = std::map<std::string, MeasuredValue>;

struct MeasuredPiece {
  std::string name{};
  programs::TestPiece piece{};
  kinematics::GeometricErrors base{};  // errors that are there whatever the unknowns
  std::vector<MeasuredPart> parts{};   // of the same piece, at least one
  std::optional<metrology::CmmModel> cmm{};
  trials::TrialOptions options{};  // of what is cut
  // Its program as commanded; null: whoever needs it commands it.
  std::shared_ptr<const trials::CommandedPiece> commanded{};
};

struct PieceObservations {
  Observations observations{};  // gain with all unknowns at zero
  // What the pieces would measure with all unknowns at zero; to be taken off the values before they
  // are identified without refinement.
  Eigen::VectorXd without_unknowns{};
  Model model{};                               // for refine()
  std::optional<double> degrees_of_freedom{};  // where repeated parts gave the covariance
  std::vector<std::string> left_out{};         // measured forms and zones, which have no derivative
};

// `unknowns` and `causes` belong together, one by one.
[[nodiscard]] Result<PieceObservations> observations_of(const kinematics::Machine& machine,
                                                        const std::vector<MeasuredPiece>& pieces,
                                                        std::vector<Unknown> unknowns,
                                                        const std::vector<Cause>& causes);

// Values of several parts of one kind in the mean; the uncertainties are those of the first.
[[nodiscard]] MeasuredPart mean_of(const std::vector<MeasuredPart>& parts);

// The pattern or feature that a characteristic belongs to: "1-a" of "1-a.dL".
[[nodiscard]] std::string group_of(const std::string& characteristic);

}  // namespace frustum::calibration
