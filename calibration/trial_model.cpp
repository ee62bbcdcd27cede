#include "calibration/trial_model.hpp"

#include <fmt/format.h>

#include <utility>

#include "trials/sensitivity.hpp"

namespace frustum::calibration {
namespace {

bool acts_on(const Cause& cause, std::size_t piece) {
  return !cause.only_piece || *cause.only_piece == piece;
}

// The piece cut by a machine with all causes at x.
Result<trials::Sensitivity> answer(const kinematics::Machine& machine, const StudiedPiece& studied,
                                   std::size_t index, const std::vector<Cause>& causes,
                                   const Eigen::VectorXd& x) {
  kinematics::GeometricErrors errors = studied.base;
  programs::TestPiece piece = studied.piece;
  std::vector<trials::Parameter> parameters;
  for (std::size_t k = 0; k < causes.size(); ++k) {
    const Cause& cause = causes[k];
    parameters.push_back(cause.parameter);
    const double amount = x[static_cast<Eigen::Index>(k)];
    if (!acts_on(cause, index)) continue;
    if (cause.parameter.unit) {
      errors = errors.plus(*cause.parameter.unit, amount);
    } else {
      for (auto& [number, tool] : piece.tools) tool.radius_error.value += amount;
    }
  }
  return trials::sensitivity(machine, errors, piece, parameters, studied.path_bound);
}

Diagnostics named(Diagnostics problems, const std::string& piece) {
  for (Diagnostic& d : problems) d.message = fmt::format("part '{}': {}", piece, d.message);
  return problems;
}

std::optional<Eigen::Index> row_of(const metrology::Measurement& measurement,
                                   const std::string& name) {
  for (std::size_t i = 0; i < measurement.characteristics.size(); ++i) {
    if (measurement.characteristics[i].name == name) return static_cast<Eigen::Index>(i);
  }
  return std::nullopt;
}

Eigen::Index rows_of(const std::vector<StudiedPiece>& pieces) {
  std::size_t rows = 0;
  for (const StudiedPiece& piece : pieces) rows += piece.characteristics.size();
  return static_cast<Eigen::Index>(rows);
}

}  // namespace

Model trial_model(kinematics::Machine machine, std::vector<StudiedPiece> pieces,
                  std::vector<Cause> causes) {
  return [machine = std::move(machine), pieces = std::move(pieces),
          causes = std::move(causes)](const Eigen::VectorXd& x) -> Result<Prediction> {
    const Eigen::Index rows = rows_of(pieces);
    const auto columns = static_cast<Eigen::Index>(causes.size());
    Prediction prediction{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, columns)};
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto answered = answer(machine, pieces[i], i, causes, x);
      if (!answered) return named(answered.error(), pieces[i].name);
      const Eigen::VectorXd values = trials::values_of(answered->measurement);
      for (const std::string& name : pieces[i].characteristics) {
        const auto at = row_of(answered->measurement, name);
        if (!at) {
          return error(fmt::format("part '{}' has no characteristic '{}'", pieces[i].name, name),
                       "take it out of the measured values, or add it to the plan");
        }
        prediction.values[row] = values[*at];
        for (Eigen::Index k = 0; k < columns; ++k) {
          if (acts_on(causes[static_cast<std::size_t>(k)], i)) {
            prediction.gain(row, k) = answered->odd(*at, k);
          }
        }
        ++row;
      }
    }
    return prediction;
  };
}

}  // namespace frustum::calibration
