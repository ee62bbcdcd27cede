#include "calibration/identify/piece_observations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "calibration/identify/repeatability.hpp"
#include "metrology/uncertainty/propagation.hpp"

namespace frustum::calibration {
namespace {

Diagnostic in_piece(const MeasuredPiece& piece, const std::string& what, const std::string& hint) {
  return error("measured-part"_id, fmt::format("part '{}': {}", piece.name, what), hint);
}

// The measured characteristics in the order of the plan; forms and zones go to `left_out`.
Result<std::vector<std::string>> rows_of(const MeasuredPiece& piece,
                                         std::vector<std::string>& left_out) {
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
    (metrology::has_derivative(planned.kind) ? rows : left_out).push_back(planned.name);
  }
  if (rows.empty()) {
    return in_piece(
        piece, "nothing was measured that changes in proportion to the errors",
        "distances, angles, radii and diameters do; forms and zones of a nearly perfect "
        "part only grow");
  }
  return rows;
}

// Stated standard uncertainty of a row, the quadratic mean of the parts'; nothing when none states
// one.
Result<std::optional<double>> stated_uncertainty(const MeasuredPiece& piece,
                                                 const std::string& row) {
  double squares = 0.0;
  std::size_t stated = 0;
  for (const MeasuredPart& part : piece.parts) {
    const auto& uncertainty = part.at(row).uncertainty;
    if (!uncertainty) continue;
    squares += *uncertainty * *uncertainty;
    ++stated;
  }
  if (stated == 0) return std::optional<double>();
  if (stated < piece.parts.size()) {
    return in_piece(
        piece,
        fmt::format("'{}' has an uncertainty on {} of {} parts", row, stated, piece.parts.size()),
        "state it on all parts, or on none");
  }
  return std::optional(std::sqrt(squares / static_cast<double>(stated)));
}

// Covariance of one part's rows.
Result<Eigen::MatrixXd> covariance_of(const MeasuredPiece& piece,
                                      const std::vector<std::string>& rows,
                                      const metrology::Measurement& nominal) {
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  std::vector<Eigen::Index> from_machine;
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto stated = stated_uncertainty(piece, rows[static_cast<std::size_t>(i)]);
    if (!stated) return stated.error();
    if (*stated) {
      covariance(i, i) = **stated * **stated;
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
    return static_cast<Eigen::Index>(*nominal.find(rows[static_cast<std::size_t>(row)]));
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
    const auto& characteristic = nominal.characteristics[*nominal.find(name)];
    described.push_back({name, group_of(name), metrology::is_angle(characteristic)});
  }
  return described;
}

// The rows of one piece, pooled over its parts.
struct PieceRows {
  std::vector<Row> rows{};
  PooledParts pooled{};
};

Result<PieceRows> piece_rows(const MeasuredPiece& piece, const std::vector<std::string>& names,
                             const metrology::Measurement& nominal) {
  const auto covariance = covariance_of(piece, names, nominal);
  if (!covariance) return covariance.error();
  std::vector<Eigen::VectorXd> parts;
  for (const MeasuredPart& part : piece.parts) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(names.size()));
    for (std::size_t i = 0; i < names.size(); ++i) {
      values[static_cast<Eigen::Index>(i)] = part.at(names[i]).value;
    }
    parts.push_back(std::move(values));
  }
  PieceRows found{described(names, nominal), {}};
  auto pooled = pool(found.rows, parts, *covariance);
  if (!pooled) return std::move(pooled).error();
  found.pooled = *std::move(pooled);
  return found;
}

// Appends rows as a block of their own.
void append(PieceObservations& all, const PieceRows& piece, const Prediction& at_zero) {
  Observations& o = all.observations;
  const Eigen::Index before = o.values.size(), more = piece.pooled.mean.size();
  o.rows.insert(o.rows.end(), piece.rows.begin(), piece.rows.end());
  o.values.conservativeResize(before + more);
  o.values.tail(more) = piece.pooled.mean;
  all.without_unknowns.conservativeResize(before + more);
  all.without_unknowns.tail(more) = at_zero.values;
  o.gain.conservativeResize(before + more, at_zero.gain.cols());
  o.gain.bottomRows(more) = at_zero.gain;
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(before + more, before + more);
  covariance.topLeftCorner(before, before) = o.covariance;
  covariance.bottomRightCorner(more, more) = piece.pooled.covariance;
  o.covariance = std::move(covariance);
}

}  // namespace

std::string group_of(const std::string& characteristic) {
  return characteristic.substr(0, characteristic.rfind('.'));
}

MeasuredPart mean_of(const std::vector<MeasuredPart>& parts) {
  MeasuredPart mean;
  for (const auto& [name, first] : parts.front()) {
    double sum = 0.0;
    for (const MeasuredPart& part : parts) {
      const auto at = part.find(name);
      sum += at == part.end() ? std::numeric_limits<double>::quiet_NaN() : at->second.value;
    }
    mean.emplace(name, MeasuredValue{sum / static_cast<double>(parts.size()), first.uncertainty});
  }
  return mean;
}

Result<PieceObservations> observations_of(const kinematics::Machine& machine,
                                          const std::vector<MeasuredPiece>& pieces,
                                          std::vector<Unknown> unknowns,
                                          const std::vector<Cause>& causes) {
  PieceObservations found;
  found.observations.unknowns = std::move(unknowns);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(causes.size()));
  std::vector<StudiedPiece> studied;
  for (const MeasuredPiece& piece : pieces) {
    const auto names = rows_of(piece, found.left_out);
    if (!names) return names.error();
    const std::size_t index = studied.size();
    studied.push_back(commanded(
        machine, {piece.name, piece.piece, piece.base, *names, piece.options, piece.commanded}));
    const auto answer = answer_of(machine, studied.back(), index, causes, zero);
    if (!answer) return answer.error();
    const auto at_zero = rows_of(studied.back(), index, causes, *answer);
    if (!at_zero) return at_zero.error();
    const auto rows = piece_rows(piece, *names, answer->measurement);
    if (!rows) return rows.error();
    append(found, *rows, *at_zero);
    if (const auto freedom = rows->pooled.degrees_of_freedom) {
      found.degrees_of_freedom = std::min(found.degrees_of_freedom.value_or(*freedom), *freedom);
    }
  }
  found.model = trial_model(machine, std::move(studied), causes);
  return found;
}

}  // namespace frustum::calibration
