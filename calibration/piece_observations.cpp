#include "calibration/piece_observations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "calibration/repeatability.hpp"
#include "metrology/characteristic.hpp"
#include "metrology/propagation.hpp"
#include "trials/trial.hpp"

namespace frustum::calibration {
namespace {

Diagnostic in_piece(const MeasuredPiece& piece, const std::string& what, const std::string& hint) {
  return error(fmt::format("part '{}': {}", piece.name, what), hint);
}

// The measured characteristics in the order of the plan.
Result<std::vector<std::string>> rows_of(const MeasuredPiece& piece) {
  std::vector<std::string> rows;
  for (const auto& planned : piece.piece.plan.characteristics) {
    const auto count =
        std::count_if(piece.parts.begin(), piece.parts.end(),
                      [&](const MeasuredPart& part) { return part.contains(planned.name); });
    if (count == 0) continue;
    if (count < static_cast<std::ptrdiff_t>(piece.parts.size())) {
      return in_piece(piece,
                      fmt::format("'{}' was measured on {} of {} parts", planned.name, count,
                                  piece.parts.size()),
                      "parts of one kind are measured alike");
    }
    rows.push_back(planned.name);
  }
  if (rows.empty()) return in_piece(piece, "nothing was measured that its plan has", "");
  return rows;
}

// Covariance of one part's rows.
Result<Eigen::MatrixXd> covariance_of(const MeasuredPiece& piece,
                                      const std::vector<std::string>& rows,
                                      const metrology::Measurement& nominal) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  std::vector<Eigen::Index> from_machine;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& stated = piece.parts.front().at(rows[static_cast<std::size_t>(i)]).uncertainty;
    if (stated) {
      covariance(i, i) = *stated * *stated;
    } else {
      from_machine.push_back(i);
    }
  }
  if (from_machine.empty()) return covariance;
  if (!piece.cmm) {
    return in_piece(piece,
                    fmt::format("'{}' has no uncertainty",
                                rows[static_cast<std::size_t>(from_machine.front())]),
                    "state it with the value, or the measuring machine as "
                    "uncertainty.cmm = { e0 = \"0.5 um\", l_per_um = 600 }");
  }
  const auto whole = metrology::covariance(piece.piece.plan, nominal, *piece.cmm);
  if (!whole) return whole.error();
  const auto place = [&](Eigen::Index row) {
    const auto& all = nominal.characteristics;
    const auto at = std::find_if(all.begin(), all.end(), [&](const auto& c) {
      return c.name == rows[static_cast<std::size_t>(row)];
    });
    return static_cast<Eigen::Index>(at - all.begin());
  };
  for (const Eigen::Index i : from_machine) {
    for (const Eigen::Index k : from_machine) covariance(i, k) = (*whole)(place(i), place(k));
  }
  return covariance;
}

std::vector<Row> described(const std::vector<std::string>& rows,
                           const metrology::Measurement& nominal) {
  std::vector<Row> described;
  for (const std::string& name : rows) {
    const auto& all = nominal.characteristics;
    const auto at =
        std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
    const bool angular = at->unit == "urad" || at->unit == "deg";
    described.push_back({name, group_of(name), angular});
  }
  return described;
}

Result<metrology::Measurement> nominal_measurement(const kinematics::Machine& machine,
                                                   const MeasuredPiece& piece) {
  trials::TrialOptions options;
  options.path_bound = piece.path_bound;
  options.find_collisions = false;
  const auto trial = trials::run_trial(machine, piece.base, piece.piece, {}, options);
  if (!trial) return trial.error();
  return trial->measurement;
}

// The rows of one piece, pooled over its parts.
struct PieceRows {
  std::vector<Row> rows{};
  PooledParts pooled{};
};

Result<PieceRows> piece_rows(const kinematics::Machine& machine, const MeasuredPiece& piece,
                             const std::vector<std::string>& names) {
  const auto nominal = nominal_measurement(machine, piece);
  if (!nominal) return nominal.error();
  const auto covariance = covariance_of(piece, names, *nominal);
  if (!covariance) return covariance.error();
  std::vector<Eigen::VectorXd> parts;
  for (const MeasuredPart& part : piece.parts) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) {
      values[static_cast<Eigen::Index>(i)] = part.at(names[i]).value;
    }
    parts.push_back(std::move(values));
  }
  PieceRows found{described(names, *nominal), {}};
  auto pooled = pool(found.rows, parts, *covariance);
  if (!pooled) return std::move(pooled).error();
  found.pooled = *std::move(pooled);
  return found;
}

// Appends `piece` as a block of its own.
void append(Observations& all, const PieceRows& piece) {
  const Eigen::Index before = all.values.size(), more = piece.pooled.mean.size();
  all.rows.insert(all.rows.end(), piece.rows.begin(), piece.rows.end());
  all.values.conservativeResize(before + more);
  all.values.tail(more) = piece.pooled.mean;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(before + more, before + more);
  covariance.topLeftCorner(before, before) = all.covariance;
  covariance.bottomRightCorner(more, more) = piece.pooled.covariance;
  all.covariance = std::move(covariance);
}

}  // namespace

std::string group_of(const std::string& characteristic) {
  return characteristic.substr(0, characteristic.rfind('.'));
}

Result<PieceObservations> observations_of(const kinematics::Machine& machine,
                                          const std::vector<MeasuredPiece>& pieces,
                                          std::vector<Unknown> unknowns,
                                          const std::vector<Cause>& causes) {
  PieceObservations found;
  found.observations.unknowns = std::move(unknowns);
  std::vector<StudiedPiece> studied;
  for (const MeasuredPiece& piece : pieces) {
    const auto names = rows_of(piece);
    if (!names) return names.error();
    const auto rows = piece_rows(machine, piece, *names);
    if (!rows) return rows.error();
    append(found.observations, *rows);
    if (const auto freedom = rows->pooled.degrees_of_freedom) {
      found.degrees_of_freedom = std::min(found.degrees_of_freedom.value_or(*freedom), *freedom);
    }
    studied.push_back({piece.name, piece.piece, piece.base, *names, piece.path_bound});
  }
  found.model = trial_model(machine, std::move(studied), causes);
  const auto start = found.model(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(causes.size())));
  if (!start) return start.error();
  found.observations.gain = start->gain;
  found.without_unknowns = start->values;
  return found;
}

}  // namespace frustum::calibration
