#include "app/study/study_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/study/piece_model.hpp"
#include "app/study/sampler.hpp"
#include "core/linear_algebra.hpp"
#include "programs/cone/cone_frustum.hpp"
#include "studies/statistics/summary.hpp"

namespace frustum::app {
namespace {

// Draws of the medians.
constexpr std::uint64_t kMapDraws = 4096;
constexpr double kShownForm = 1.0;  // um

programs::ConeFrustum cone_at(double cone_angle_deg, double inclination_deg,
                              const std::vector<double>& center) {
  programs::ConeFrustum cone;
  cone.cone_angle = Rad{cone_angle_deg * kRadPerDeg};
  cone.inclination = Rad{inclination_deg * kRadPerDeg};
  cone.center = Vec3(center[0], center[1], center[2]);
  return cone;
}

// Form that a factor makes alone: its columns, the largest weight of each, any phase.
double largest_form(const studies::FactorSet& factors, const studies::Factor& factor,
                    const Eigen::MatrixXd& gains, const std::vector<double>& largest) {
  const auto form = [](const Eigen::VectorXd& x) { return x.maxCoeff() - x.minCoeff(); };
  double most = 0.0;
  for (std::size_t k = 0; k < factor.columns.size(); ++k) {
    const std::size_t j = factor.columns[k];
    const Eigen::VectorXd one = gains.col(static_cast<Eigen::Index>(j)) * largest[j];
    if (factors.columns()[j].wave != studies::Wave::cosine || k + 1 == factor.columns.size()) {
      most = std::max(most, form(one));
      continue;
    }
    const Eigen::VectorXd other =
        gains.col(static_cast<Eigen::Index>(factor.columns[k + 1])) * largest[j];
    constexpr int kPhases = 90;
    for (int i = 0; i < kPhases; ++i) {
      const double phase = std::numbers::pi * i / kPhases;
      most = std::max(most, form(std::cos(phase) * one - std::sin(phase) * other));
    }
    ++k;
  }
  return most;
}

Result<studies::MapRow> row_of(const StudyFile& study, double cone_angle, double inclination,
                               const std::vector<double>& center) {
  StudyFile at = study;
  auto piece = programs::cone_frustum(cone_at(cone_angle, inclination, center), study.machine());
  if (!piece) return piece.error();
  // What a set-up makes is asked, not whether it is good enough.
  piece->reading = at.job->piece.reading;
  at.job->piece = *std::move(piece);
  at.characteristics = characteristics_of(at.job->piece.plan);
  const auto model = make_piece_model(at);
  if (!model) return model.error();
  const auto view = (*model)->linear_view(0);
  if (!view) return error("not-linear"_id, "the form of this cone is not linear in the errors");
  const studies::FactorSet& factors = (*model)->factors();
  studies::MapRow row{cone_angle, inclination, center};
  const studies::WeightMoments moments = factors.weight_moments();
  const Eigen::MatrixXd covariance = view->gains * moments.covariance * view->gains.transpose();
  row.rms_um = std::sqrt(covariance.trace() / static_cast<double>(view->gains.rows()));
  const Eigen::VectorXd spread = symmetric_eigenvalues(covariance);
  row.directions = spread.sum() * spread.sum() / spread.squaredNorm();
  const std::vector<double> largest = factors.largest_weights();
  for (const studies::Factor& factor : factors.factors()) {
    if (largest_form(factors, factor, view->gains, largest) >= kShownForm) ++row.shown;
  }
  const auto sampler = Sampler::make(at, **model, studies::EngineKind::linear);
  if (!sampler) return sampler.error();
  std::vector<double> weights(kMapDraws * factors.columns().size());
  std::size_t next = 0;
  for (const DrawnMachine& machine : sampler->machines(0, kMapDraws)) {
    factors.weights(machine.values, std::span(weights).subspan(next, factors.columns().size()));
    next += factors.columns().size();
  }
  std::vector<double> values = view->values(weights);
  std::ranges::sort(values);
  row.median_um = studies::sorted_quantile(values, 0.5);
  row.median_ci95 = studies::quantile_interval(values, 0.5);
  row.q95_um = studies::sorted_quantile(values, 0.95);
  return row;
}

}  // namespace

Result<std::vector<studies::MapRow>> map_of(const StudyFile& study) {
  std::vector<studies::MapRow> rows;
  if (!study.questions.map) return rows;
  for (const auto& center : study.questions.map->center_mm) {
    for (const double cone_angle : study.questions.map->cone_angle_deg) {
      for (const double inclination : study.questions.map->inclination_deg) {
        auto row = row_of(study, cone_angle, inclination, center);
        if (!row) return row.error();
        rows.push_back(*std::move(row));
      }
    }
  }
  return rows;
}

}  // namespace frustum::app
