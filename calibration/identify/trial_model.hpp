// What a machine with given errors would make of some test pieces: whole trials as the model of a
// refinement.
//
// Model    : every piece is cut with the base errors plus the causes at x and measured without
//            noise; values and derivatives are those of trials::sensitivity()
// Units    : mm, rad
// Shape    : rows: the characteristics of the first piece in their order, then those of the next;
//            columns: the causes
// Errors   : those of the trials, with the piece's name; a characteristic that its plan does not
//            have
// Accuracy : that of trials::sensitivity()
// Source   : ours
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/identify/refinement.hpp"
#include "kinematics/model/machine.hpp"
#include "programs/test_piece.hpp"
#include "trials/parameter.hpp"
#include "trials/sensitivity.hpp"

namespace frustum::calibration {

struct StudiedPiece {
  std::string name{};
  programs::TestPiece piece{};
  kinematics::GeometricErrors base{};          // errors that are there whatever the causes
  std::vector<std::string> characteristics{};  // rows, by name
  trials::TrialOptions options{};              // of what is cut
  // Its program as commanded; null: whoever needs it commands it.
  std::shared_ptr<const trials::CommandedPiece> commanded{};
};

// Something that changes what is cut: a machine error for all pieces, a tool radius for all or one.
struct Cause {
  trials::Parameter parameter{};
  std::optional<std::size_t> only_piece{};
};

// The piece with its program commanded; as it was where the controller refuses it.
[[nodiscard]] StudiedPiece commanded(const kinematics::Machine& machine, StudiedPiece piece);

// One piece cut by a machine with all causes at x: what is measured, and the derivatives to the
// causes that act on it (columns in the order of causes_on()).
[[nodiscard]] Result<trials::Sensitivity> answer_of(const kinematics::Machine& machine,
                                                    const StudiedPiece& piece, std::size_t index,
                                                    const std::vector<Cause>& causes,
                                                    const Eigen::VectorXd& x);
// Which causes act on a piece.
[[nodiscard]] std::vector<std::size_t> causes_on(std::size_t piece,
                                                 const std::vector<Cause>& causes);
// Its rows of a prediction. Error: a characteristic that the measurement lacks.
[[nodiscard]] Result<Prediction> rows_of(const StudiedPiece& piece, std::size_t index,
                                         const std::vector<Cause>& causes,
                                         const trials::Sensitivity& answer);

// The pieces and causes are copied into the model; every program is commanded once.
[[nodiscard]] Model trial_model(kinematics::Machine machine, std::vector<StudiedPiece> pieces,
                                std::vector<Cause> causes);

}  // namespace frustum::calibration
