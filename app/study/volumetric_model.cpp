#include "app/study/volumetric_model.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "app/study/piece_model.hpp"
#include "core/units.hpp"
#include "kinematics/errors/error_gain.hpp"
#include "kinematics/model/chain.hpp"
#include "studies/statistics/normal_length.hpp"
#include "studies/statistics/summary.hpp"

namespace frustum::app {
namespace {

using kinematics::GeometricErrors;

class VolumetricModel final : public StudyModel {
 public:
  VolumetricModel(const VolumetricTarget& target, studies::FactorSet factors)
      : target_(target), factors_(std::move(factors)) {
    gains_.resize(3, static_cast<Eigen::Index>(factors_.columns().size()));
    for (std::size_t j = 0; j < factors_.columns().size(); ++j) {
      gains_.col(static_cast<Eigen::Index>(j)) = first_order(factors_.columns()[j].unit);
    }
    fixed_ = first_order(factors_.fixed());
    nominal_ = tip_of(GeometricErrors{});
    const auto length = [&](const char* name, const Vec3& constant) {
      return studies::LinearCharacteristic{name, "um",
                                           studies::LinearLength{1.0, 3, constant, gains_}};
    };
    engine_ = std::make_unique<studies::LinearEngine>(
        factors_, studies::LinearModel{{length(kVolumetricError.data(), fixed_),
                                        length("largest move", Vec3::Zero())}});
  }

  const studies::FactorSet& factors() const override { return factors_; }
  std::size_t point_count() const override { return 0; }
  const Eigen::MatrixXd& gains() const override { return gains_; }
  const studies::LinearEngine* linear_engine() const override { return engine_.get(); }
  std::string against_linear() const override {
    return factors_.nonlinear().empty()
               ? std::string()
               : "not linear in what is drawn: " + factors_.nonlinear().front();
  }
  double measuring_uncertainty(std::size_t) const override { return 0.0; }
  std::optional<LinearView> linear_view(std::size_t) const override {
    const auto values = [this](std::span<const double> weights) {
      const Eigen::Index n = gains_.cols();
      std::vector<double> lengths(n == 0 ? 0 : weights.size() / static_cast<std::size_t>(n));
      for (std::size_t i = 0; i < lengths.size(); ++i) {
        const Eigen::Map<const Eigen::VectorXd> row(
            weights.data() + i * static_cast<std::size_t>(n), n);
        lengths[i] = (fixed_ + Vec3(gains_ * row)).norm();
      }
      return lengths;
    };
    return LinearView{gains_, values};
  }
  const Vec3& fixed() const { return fixed_; }

  std::vector<DrawOutcome> full(std::span<const DrawnMachine> draws,
                                const EvaluationRequest& request) const override {
    std::vector<DrawOutcome> outcomes(draws.size());
    tbb::parallel_for(std::size_t{0}, draws.size(), [&](std::size_t i) {
      const auto errors = errors_of(draws[i], request.scale);
      if (errors) {
        outcomes[i].values = {(tip_of(*errors) - nominal_).norm() * kUmPerMm};
      } else {
        outcomes[i].failure = errors.error().front().message;
      }
    });
    return outcomes;
  }

  std::vector<DrawOutcome> linear(std::span<const DrawnMachine> draws,
                                  const EvaluationRequest& request) const override {
    return in_lanes(*engine_, factors_, draws, request.scale);
  }

 private:
  Vec3 first_order(const GeometricErrors& errors) const {
    return kinematics::first_order_displacement(target_.machine, errors, target_.at,
                                                target_.tool_length)
               .tip *
           kUmPerMm;
  }
  Vec3 tip_of(const GeometricErrors& errors) const {
    return kinematics::ForwardChain(target_.machine, errors, target_.tool_length)
        .table_from_tool(target_.at)
        .translation;
  }
  Eigen::VectorXd weights_of(const DrawnMachine& machine, double scale) const {
    Eigen::VectorXd weights(gains_.cols());
    factors_.weights(machine.values, {weights.data(), factors_.columns().size()});
    return scale * weights;
  }
  Result<GeometricErrors> errors_of(const DrawnMachine& machine, double scale) const {
    if (scale == 1.0) return factors_.errors_at(target_.machine, machine.values);
    const Eigen::VectorXd weights = weights_of(machine, scale);
    GeometricErrors errors = factors_.fixed();
    for (std::size_t j = 0; j < factors_.columns().size(); ++j) {
      errors = errors.plus(factors_.columns()[j].unit, weights[static_cast<Eigen::Index>(j)]);
    }
    return errors;
  }

  const VolumetricTarget& target_;
  studies::FactorSet factors_;
  Eigen::MatrixXd gains_{};
  Vec3 fixed_ = Vec3::Zero();
  Vec3 nominal_ = Vec3::Zero();
  std::unique_ptr<studies::LinearEngine> engine_{};
};

}  // namespace

Result<std::unique_ptr<StudyModel>> make_volumetric_model(const StudyFile& study) {
  auto factors = studies::FactorSet::make(
      study.machine(), study.errors,
      {.read_as = study.read_as, .scale = study.scale, .correlated = study.correlated});
  if (!factors) return std::move(factors).error();
  return std::unique_ptr<StudyModel>(
      std::make_unique<VolumetricModel>(*study.volumetric, *std::move(factors)));
}

std::optional<studies::ExactLength> exact_length(const StudyModel& model,
                                                 std::optional<double> limit) {
  const auto* volumetric = dynamic_cast<const VolumetricModel*>(&model);
  if (volumetric == nullptr || !model.factors().nonlinear().empty()) return std::nullopt;
  const studies::FactorSet& factors = model.factors();
  const bool is_normal = std::ranges::all_of(factors.variables(), [](const auto& variable) {
    return variable.law.kind == studies::Law::Kind::normal && !variable.law.limit;
  });
  const bool is_linear = std::ranges::all_of(factors.amounts(), [](const auto& amount) {
    return amount.parts.size() == 1 &&
           amount.parts.front().function == kinematics::DrawnFactor::Function::itself;
  });
  const bool has_phase =
      std::ranges::any_of(factors.columns(), [](const auto& c) { return c.phase.has_value(); });
  if (!is_normal || !is_linear || has_phase) return std::nullopt;
  const studies::WeightMoments moments = factors.weight_moments();
  const Vec3 mean = volumetric->fixed() + Vec3(model.gains() * moments.mean);
  const Mat3 covariance = model.gains() * moments.covariance * model.gains().transpose();
  const studies::NormalLength length(mean, covariance);
  studies::ExactLength exact{.mean = length.mean(), .rms = length.rms()};
  for (const double p : studies::kQuantiles) {
    exact.quantiles.push_back({.p = p, .value = length.quantile(p)});
  }
  if (limit) exact.conform = length.probability(*limit);
  return exact;
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
  return study.job ? make_piece_model(study) : make_volumetric_model(study);
}

}  // namespace frustum::app
