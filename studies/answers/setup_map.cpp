#include "studies/answers/setup_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/linear_algebra.hpp"
#include "studies/engine/linear_engine.hpp"

namespace frustum::studies {
namespace {

constexpr double kShown = 1.0;  // um

// Second moments of the weights, factor by factor.
Eigen::MatrixXd own_second_moments(const FactorSet& set) {
  const WeightMoments moments = set.weight_moments();
  Eigen::MatrixXd second = moments.covariance;
  for (const Factor& factor : set.factors()) {
    for (const std::size_t i : factor.columns) {
      for (const std::size_t j : factor.columns) {
        const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
        second(row, column) += moments.mean[row] * moments.mean[column];
      }
    }
  }
  return second;
}

double range_of(const Eigen::VectorXd& x) { return x.maxCoeff() - x.minCoeff(); }

Result<MapRow> row_of(const kinematics::Machine& machine,
                      std::span<const kinematics::ErrorEntry> errors, const ConeRing& ring,
                      const MapOptions& options) {
  const auto path = cone_path(machine, ring);
  if (!path) return path.error();
  FactorOptions factors = options.factors;
  factors.spans = path->spans;
  const auto set = FactorSet::make(machine, errors, factors);
  if (!set) return set.error();
  const Eigen::MatrixXd gains = kUmPerMm * ring_gains(machine, *path, *set, ring.tool_length);
  MapRow row{.cone_angle_deg = ring.half_angle * kDegPerRad,
             .inclination_deg = ring.inclination * kDegPerRad,
             .center_mm = {ring.center.x(), ring.center.y(), ring.center.z()}};
  // Sum and sum of squares of the eigenvalues are trace and squared norm.
  const Eigen::MatrixXd points = gains * own_second_moments(*set) * gains.transpose();
  const double trace = points.trace();
  row.rms_um = std::sqrt(trace / static_cast<double>(points.rows()));
  row.directions = trace * trace / points.squaredNorm();
  const std::vector<double> forms = forms_at_limits(*set, gains);
  row.shown = static_cast<std::size_t>(
      std::count_if(forms.begin(), forms.end(), [](double form) { return form >= kShown; }));
  LinearModel model = cone_model(machine, *path, *set, ring);
  model.characteristics.resize(1);
  const std::vector<std::uint64_t> streams = set->streams();
  const auto scheme = Scheme::make(SchemeKind::random, options.seed, streams);
  if (!scheme) return scheme.error();
  std::vector<double> values =
      LinearEngine(*set, model).evaluate(*scheme, options.seed, 0, options.draws);
  std::sort(values.begin(), values.end());
  row.median_um = sorted_quantile(values, 0.5);
  row.median_ci95 = quantile_interval(values, 0.5);
  row.q95_um = sorted_quantile(values, 0.95);
  return row;
}

}  // namespace

std::vector<double> forms_at_limits(const FactorSet& set, const Eigen::MatrixXd& gains) {
  const std::vector<double> largest = set.largest_weights();
  std::vector<double> forms;
  for (const Factor& factor : set.factors()) {
    double form = 0.0;
    for (const std::size_t j : factor.columns) {
      const Eigen::VectorXd a = largest[j] * gains.col(static_cast<Eigen::Index>(j));
      if (set.columns()[j].wave == Wave::none) {
        form += range_of(a);
      } else if (set.columns()[j].wave == Wave::cosine) {
        // Its sine is the next column.
        const Eigen::VectorXd b = largest[j + 1] * gains.col(static_cast<Eigen::Index>(j + 1));
        form += std::max(range_of(a), range_of(b));
      }
    }
    forms.push_back(form);
  }
  return forms;
}

Result<std::vector<MapRow>> setup_map(const kinematics::Machine& machine,
                                      std::span<const kinematics::ErrorEntry> errors,
                                      std::span<const ConeRing> rings, const MapOptions& options) {
  std::vector<MapRow> rows;
  Diagnostics problems;
  for (const ConeRing& ring : rings) {
    if (!(ring.half_angle > ring.inclination)) {
      problems.push_back(error(
          "map-setup"_id,
          fmt::format("[map]: a cone angle of {:g} deg at an inclination of {:g} deg is not mapped",
                      ring.half_angle * kDegPerRad, ring.inclination * kDegPerRad),
          "the cone angle must be above the inclination"));
      continue;
    }
    auto row = row_of(machine, errors, ring, options);
    if (row) {
      rows.push_back(*std::move(row));
    } else {
      for (Diagnostic& d : std::move(row).error()) problems.push_back(std::move(d));
    }
  }
  if (!problems.empty()) return problems;
  return rows;
}

}  // namespace frustum::studies
