#include "calibration/identify/trial_model.hpp"

#include <fmt/format.h>

#include <utility>

namespace frustum::calibration {
namespace {

Diagnostics named(Diagnostics problems, const std::string& piece) {
  for (Diagnostic& d : problems) d.message = fmt::format("part '{}': {}", piece, d.message);
  return problems;
}

Eigen::Index total_rows(const std::vector<StudiedPiece>& pieces) {
  std::size_t rows = 0;
  for (const StudiedPiece& piece : pieces) rows += piece.characteristics.size();
  return static_cast<Eigen::Index>(rows);
}

}  // namespace

std::vector<std::size_t> causes_on(std::size_t piece, const std::vector<Cause>& causes) {
  std::vector<std::size_t> acting;
  for (std::size_t k = 0; k < causes.size(); ++k) {
    if (!causes[k].only_piece || *causes[k].only_piece == piece) acting.push_back(k);
  }
  return acting;
}

StudiedPiece commanded(const kinematics::Machine& machine, StudiedPiece piece) {
  if (piece.commanded) return piece;
  if (auto program = trials::command_piece(machine, piece.piece)) {
    piece.commanded = std::make_shared<const trials::CommandedPiece>(*std::move(program));
  }
  return piece;
}

Result<trials::Sensitivity> answer_of(const kinematics::Machine& machine,
                                      const StudiedPiece& studied, std::size_t index,
                                      const std::vector<Cause>& causes, const Eigen::VectorXd& x) {
  kinematics::GeometricErrors errors = studied.base;
  programs::TestPiece piece = studied.piece;
  std::vector<trials::Parameter> parameters;
  for (const std::size_t k : causes_on(index, causes)) {
    const trials::Parameter& parameter = causes[k].parameter;
    const double amount = x[static_cast<Eigen::Index>(k)];
    parameters.push_back(parameter);
    if (parameter.unit) {
      errors = errors.plus(*parameter.unit, amount);
    } else {
      for (auto& [number, tool] : piece.tools) tool.radius_error.value += amount;
    }
  }
  auto answer = studied.commanded
                    ? trials::sensitivity(machine, errors, piece, *studied.commanded, parameters,
                                          studied.options)
                    : trials::sensitivity(machine, errors, piece, parameters, studied.options);
  if (!answer) return named(answer.error(), studied.name);
  return answer;
}

Result<Prediction> rows_of(const StudiedPiece& piece, std::size_t index,
                           const std::vector<Cause>& causes, const trials::Sensitivity& answer) {
  const Eigen::VectorXd values = trials::values_of(answer.measurement);
  const std::vector<std::size_t> acting = causes_on(index, causes);
  const auto rows = static_cast<Eigen::Index>(piece.characteristics.size());
  const auto columns = static_cast<Eigen::Index>(causes.size());
  Prediction prediction{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, columns)};
  for (Eigen::Index row = 0; row < rows; ++row) {
    const std::string& name = piece.characteristics[static_cast<std::size_t>(row)];
    const auto found = answer.measurement.find(name);
    if (!found) {
      return error("unknown-characteristic"_id,
                   fmt::format("part '{}' has no characteristic '{}'", piece.name, name),
                   "take it out of the measured values, or add it to the plan");
    }
    const auto at = static_cast<Eigen::Index>(*found);
    prediction.values[row] = values[at];
    for (std::size_t j = 0; j < acting.size(); ++j) {
      prediction.gain(row, static_cast<Eigen::Index>(acting[j])) =
          answer.odd(at, static_cast<Eigen::Index>(j));
    }
  }
  return prediction;
}

Model trial_model(kinematics::Machine machine, std::vector<StudiedPiece> pieces,
                  std::vector<Cause> causes) {
  for (StudiedPiece& piece : pieces) piece = commanded(machine, std::move(piece));
  return [machine = std::move(machine), pieces = std::move(pieces),
          causes = std::move(causes)](const Eigen::VectorXd& x) -> Result<Prediction> {
    const Eigen::Index rows = total_rows(pieces);
    const auto columns = static_cast<Eigen::Index>(causes.size());
    Prediction all{Eigen::VectorXd::Zero(rows), Eigen::MatrixXd::Zero(rows, columns)};
    Eigen::Index row = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const auto answer = answer_of(machine, pieces[i], i, causes, x);
      if (!answer) return answer.error();
      const auto own = rows_of(pieces[i], i, causes, *answer);
      if (!own) return own.error();
      all.values.segment(row, own->values.size()) = own->values;
      all.gain.middleRows(row, own->gain.rows()) = own->gain;
      row += own->values.size();
    }
    return all;
  };
}

}  // namespace frustum::calibration
