#include "app/study/study_model.hpp"

#include "app/study/motion_model.hpp"
#include "app/study/piece_model.hpp"
#include "app/study/volumetric_model.hpp"

namespace frustum::app {

Eigen::VectorXd weights_of(const studies::FactorSet& factors, const DrawnMachine& machine,
                           double scale) {
  Eigen::VectorXd weights(static_cast<Eigen::Index>(factors.columns().size()));
  factors.weights(machine.values, {weights.data(), factors.columns().size()});
  return scale * weights;
}

Result<kinematics::GeometricErrors> errors_of(const studies::FactorSet& factors,
                                              const kinematics::Machine& on,
                                              const DrawnMachine& machine, double scale) {
  if (scale == 1.0) return factors.errors_at(on, machine.values);
  const Eigen::VectorXd weights = weights_of(factors, machine, scale);
  kinematics::GeometricErrors errors = factors.fixed();
  for (std::size_t j = 0; j < factors.columns().size(); ++j) {
    errors = errors.plus(factors.columns()[j].unit, weights[static_cast<Eigen::Index>(j)]);
  }
  return errors;
}

std::vector<DrawOutcome> in_lanes(const studies::LinearEngine& engine,
                                  const studies::FactorSet& factors,
                                  std::span<const DrawnMachine> draws, double scale) {
  const std::size_t columns = factors.columns().size();
  std::vector<double> weights(draws.size() * columns);
  for (std::size_t i = 0; i < draws.size(); ++i) {
    factors.weights(draws[i].values, std::span(weights).subspan(i * columns, columns));
  }
  for (double& weight : weights) weight *= scale;
  const std::vector<double> values = engine.evaluate_weights(weights);
  std::vector<DrawOutcome> outcomes(draws.size());
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const std::size_t last = engine.characteristic_count() - 1;
    for (std::size_t c = 0; c < last; ++c) {
      outcomes[i].values.push_back(values[c * draws.size() + i]);
    }
    outcomes[i].largest_move = values[last * draws.size() + i];
  }
  return outcomes;
}

Result<std::unique_ptr<StudyModel>> make_model(const StudyFile& study) {
  if (study.motion) return make_motion_model(study);
  return study.job ? make_piece_model(study) : make_volumetric_model(study);
}

}  // namespace frustum::app
