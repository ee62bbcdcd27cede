#include "calibration/design/planned_piece.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"
#include "metrology/plan/strategy.hpp"
#include "metrology/uncertainty/point_uncertainty.hpp"
#include "trials/surface_gain.hpp"
#include "trials/trial.hpp"

namespace frustum::calibration {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Points that the program cuts: where they are, their normals, what the unknowns do to them.
struct CutPoints {
  std::vector<Vec3> place{}, normal{};
  MatrixXd gain{};
};

// Points as they are on the table: without what would move them.
programs::TestPiece as_planned(programs::TestPiece piece) {
  piece.plan.alignment = metrology::Alignment::plan;
  piece.plan.characteristics.clear();
  piece.plan.datum.reset();
  piece.plan.frames.clear();
  return piece;
}

Result<CutPoints> cut_points(const kinematics::Machine& machine, const MeasuredPiece& piece,
                             const trials::Trial& trial, const std::vector<Cause>& causes) {
  std::vector<trials::Parameter> parameters;
  const std::vector<std::size_t> acting = causes_on(0, causes);
  for (const std::size_t k : acting) parameters.push_back(causes[k].parameter);
  const auto gains = trials::surface_gains(machine, as_planned(piece.piece), trial, parameters);
  if (!gains) return gains.error();
  CutPoints points;
  std::vector<Index> rows;
  Index row = 0;
  for (const auto& feature : trial.measurement.features) {
    for (std::size_t i = 0; i < feature.points.size(); ++i, ++row) {
      const auto& provenance = feature.touches[i].provenance;
      if (!provenance || !provenance->segment) continue;
      points.place.push_back(feature.points[i].point);
      points.normal.push_back(feature.points[i].normal);
      rows.push_back(row);
    }
  }
  points.gain = MatrixXd::Zero(static_cast<Index>(rows.size()), static_cast<Index>(causes.size()));
  for (std::size_t j = 0; j < acting.size(); ++j) {
    points.gain.col(static_cast<Index>(acting[j])) = gains->odd(rows, static_cast<Index>(j));
  }
  return points;
}

// What the six terms of a linear field of one standard deviation do along the normals.
MatrixXd field_of(const CutPoints& points, double scale) {
  MatrixXd field(static_cast<Index>(points.place.size()), 6);
  for (std::size_t i = 0; i < points.place.size(); ++i) {
    Index term = 0;
    for (Index row = 0; row < 3; ++row) {
      for (Index column = row; column < 3; ++column) {
        field(static_cast<Index>(i), term++) =
            scale * points.normal[i][row] * points.place[i][column];
      }
    }
  }
  return field;
}

// What a shift (mm) and a turn (rad) of the workpiece do along the normals.
MatrixXd placement_of(const CutPoints& points) {
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : points.place) middle += p / static_cast<double>(points.place.size());
  MatrixXd moved(static_cast<Index>(points.place.size()), 6);
  for (std::size_t i = 0; i < points.place.size(); ++i) {
    moved.row(static_cast<Index>(i)).head<3>() = points.normal[i].transpose();
    moved.row(static_cast<Index>(i)).tail<3>() =
        (points.place[i] - middle).cross(points.normal[i]).transpose();
  }
  return moved;
}

// G^T S^-1 G with S = p^2 + L L^T, less what the columns of M take.
MatrixXd information_of(const CutPoints& points, const metrology::PointUncertainty& noise,
                        bool is_floating) {
  const MatrixXd field = field_of(points, noise.scale);
  MatrixXd all(points.gain.rows(), points.gain.cols() + (is_floating ? 6 : 0));
  all.leftCols(points.gain.cols()) = points.gain;
  if (is_floating) all.rightCols(6) = placement_of(points);
  const double variance = noise.probing * noise.probing;
  const MatrixXd seen = field.transpose() * all;
  const MatrixXd inner = variance * MatrixXd::Identity(6, 6) + field.transpose() * field;
  const MatrixXd joint =
      (all.transpose() * all - seen.transpose() * inverse_of(inner) * seen) / variance;
  const Index n = points.gain.cols();
  if (!is_floating) return joint;
  // A piece of one plane alone leaves turns open that it does not see: no more is taken then.
  const MatrixXd nuisance = joint.bottomRightCorner(6, 6), cross = joint.topRightCorner(n, 6);
  const SymmetricEigen eigen = symmetric_eigen(nuisance);
  MatrixXd left = joint.topLeftCorner(n, n);
  for (Index k = 0; k < 6; ++k) {
    if (eigen.values[k] <= 1e-12 * eigen.values[5]) continue;
    const VectorXd taken = cross * eigen.vectors.col(k);
    left -= taken * taken.transpose() / eigen.values[k];
  }
  return left;
}

// As few rows of unit variance that hold the information.
Observations rows_with(const std::string& name, const MatrixXd& information,
                       const std::vector<Unknown>& unknowns) {
  Observations rows{.unknowns = unknowns};
  VectorXd size(information.cols());
  for (Index k = 0; k < size.size(); ++k) {
    size[k] = expected_size(unknowns[static_cast<std::size_t>(k)]);
    if (!(size[k] > 0.0)) size[k] = kExpectedLength;  // known exactly
  }
  const SymmetricEigen eigen = symmetric_eigen(size.asDiagonal() * information * size.asDiagonal());
  const double largest = std::max(eigen.values.size() > 0 ? eigen.values.maxCoeff() : 0.0, 1e-300);
  std::vector<VectorXd> kept;
  for (Index k = eigen.values.size() - 1; k >= 0; --k) {
    if (eigen.values[k] <= 1e-12 * largest) break;
    kept.emplace_back(std::sqrt(eigen.values[k]) * eigen.vectors.col(k).cwiseQuotient(size));
  }
  if (kept.empty()) kept.emplace_back(VectorXd::Zero(size.size()));
  rows.gain = MatrixXd(static_cast<Index>(kept.size()), size.size());
  for (std::size_t i = 0; i < kept.size(); ++i) {
    rows.gain.row(static_cast<Index>(i)) = kept[i].transpose();
    rows.rows.push_back({fmt::format("{}.{}", name, i + 1), name, false});
  }
  rows.values = VectorXd::Zero(rows.gain.rows());
  rows.covariance = MatrixXd::Identity(rows.gain.rows(), rows.gain.rows());
  return rows;
}

Diagnostic of_piece(const MeasuredPiece& piece, DiagnosticId id, const char* what,
                    const char* hint) {
  return error(id, fmt::format("part '{}': {}", piece.name, what), hint);
}

}  // namespace

Result<PlannedObservations> planned_observations(const kinematics::Machine& machine,
                                                 const PlannedPiece& planned, std::size_t index,
                                                 const std::vector<Unknown>& unknowns,
                                                 std::vector<Cause> causes) {
  // Of this piece, which is the only one here.
  for (Cause& cause : causes) {
    if (cause.only_piece) cause.only_piece = *cause.only_piece == index ? 0 : 1;
  }
  const MeasuredPiece& piece = planned.piece;
  if (!piece.cmm || metrology::point_uncertainty(*piece.cmm).probing <= 0.0) {
    return of_piece(piece, "no-uncertainty"_id, "nothing says how it will be measured",
                    "uncertainty.cmm = { e0 = \"0.5 um\", l_per_um = 600 }");
  }
  trials::TrialOptions options = piece.options;
  options.find_collisions = false;
  const auto trial = trials::run_trial(machine, piece.base, as_planned(piece.piece), {}, options);
  if (!trial) return trial.error();
  PlannedObservations found{.cutting_time = trial->cycle_time};
  for (const auto& feature : trial->measurement.features) found.touches += feature.points.size();
  if (planned.rows == PlannedRows::characteristics) {
    auto rows = observations_of(machine, {piece}, unknowns, causes);
    if (!rows) return std::move(rows).error();
    found.observations = std::move(rows->observations);
    return found;
  }
  const auto points = cut_points(machine, piece, *trial, causes);
  if (!points) return points.error();
  if (points->place.empty()) {
    return of_piece(piece, "nothing-measured"_id, "no probed point is on what the program cuts",
                    "features that the program makes show its errors");
  }
  found.observations = rows_with(piece.name,
                                 information_of(*points, metrology::point_uncertainty(*piece.cmm),
                                                planned.rows == PlannedRows::floating_points),
                                 unknowns);
  return found;
}

}  // namespace frustum::calibration
