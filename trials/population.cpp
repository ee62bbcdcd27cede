#include "trials/population.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "metrology/characteristic/datum_system.hpp"
#include "metrology/plan/strategy.hpp"
#include "trials/sensitivity.hpp"

namespace frustum::trials {

using kinematics::Machine;
using programs::TestPiece;

struct Population::State {
  Machine machine;
  TestPiece piece{};
  CommandedPiece commanded{};
  PopulationLaws laws{};
  PopulationOptions options{};
  Trial middle{};
  std::size_t points = 0;

  [[nodiscard]] PopulationMember whole_trial(const Weights& draw,
                                             const metrology::CmmModel& cmm) const {
    PopulationMember member;
    TrialOptions whole{.path_bound = options.path_bound};
    whole.find_collisions = false;
    const auto trial = run_trial(machine, laws.errors(draw), piece, commanded, cmm, whole);
    if (!trial) {
      member.failure = trial.error();
      return member;
    }
    const Eigen::VectorXd values = values_of(trial->measurement);
    member.values.assign(values.begin(), values.end());
    member.whole = points;
    return member;
  }
};

Result<Population> Population::make(const Machine& machine, const TestPiece& piece,
                                    const CommandedPiece& commanded, const PopulationLaws& laws,
                                    const PopulationOptions& options) {
  auto state = std::make_shared<State>(State{machine, piece, commanded, laws, options});
  TrialOptions whole{.path_bound = options.path_bound};
  whole.find_collisions = false;
  auto middle = run_trial(machine, laws.errors(laws.middle()), piece, commanded, {}, whole);
  if (!middle) return std::move(middle).error();
  state->middle = *std::move(middle);
  for (const auto& feature : piece.plan.features) {
    state->points += metrology::planned_points(feature).size();
  }
  return Population(std::move(state));
}

std::vector<PopulationMember> Population::evaluate(std::span<const Weights> draws,
                                                   const EvaluateOptions& options) const {
  std::vector<PopulationMember> members(draws.size());
  tbb::parallel_for(std::size_t{0}, draws.size(), [&](std::size_t i) {
    const metrology::CmmModel cmm = options.cmm ? options.cmm(i) : metrology::CmmModel{};
    members[i] = state_->whole_trial(draws[i], cmm);
  });
  return members;
}

const Trial& Population::middle_trial() const { return state_->middle; }
const PopulationLaws& Population::laws() const { return state_->laws; }
std::size_t Population::point_count() const { return state_->points; }

Result<SurfaceGains> Population::gains() const {
  std::vector<Parameter> columns;
  for (const ErrorColumn& column : state_->laws.columns()) {
    columns.push_back({column.error, column.angular, column.unit});
  }
  return surface_gains(state_->machine, state_->piece, state_->middle, columns);
}

Result<std::vector<double>> Population::evaluate_moved(std::span<const double> moved) const {
  const metrology::Measurement& middle = state_->middle.measurement;
  std::vector<metrology::FeaturePoints> features;
  auto by = moved.begin();
  for (const metrology::MeasuredFeature& feature : middle.features) {
    metrology::FeaturePoints points{feature.name, {}, {}};
    for (const metrology::MeasuredPoint& p : feature.points) {
      points.points.push_back(middle.workpiece_from_datum.point(p.point + *by++ * p.normal));
      points.sections.push_back(p.section);
    }
    features.push_back(std::move(points));
  }
  const auto evaluated = metrology::evaluate(state_->piece.plan, features);
  if (!evaluated) return evaluated.error();
  const Eigen::VectorXd values = values_of(*evaluated);
  return std::vector<double>(values.begin(), values.end());
}

std::vector<Population::Reason> Population::reasons() const { return {}; }

}  // namespace frustum::trials
