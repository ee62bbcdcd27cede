#include "app/study/volumetric_model.hpp"

#include <tbb/parallel_for.h>

#include "core/units.hpp"
#include "kinematics/model/chain.hpp"
#include "studies/engine/volumetric_point.hpp"
#include "studies/statistics/summary.hpp"

namespace frustum::app {
namespace {

using kinematics::GeometricErrors;

class VolumetricModel final : public StudyModel {
 public:
  VolumetricModel(const VolumetricTarget& target, studies::FactorSet factors)
      : target_(target),
        factors_(std::move(factors)),
        point_(studies::volumetric_point(target.machine, factors_, target.at, target.tool_length)),
        nominal_(tip_of(GeometricErrors{})) {
    const auto length = [&](const char* name, const Vec3& constant) {
      return studies::LinearCharacteristic{name, "um",
                                           studies::LinearLength{1.0, 3, constant, point_.gains}};
    };
    engine_ = std::make_unique<studies::LinearEngine>(
        factors_, studies::LinearModel{{length(kVolumetricError.data(), point_.fixed),
                                        length("largest move", Vec3::Zero())}});
  }

  const studies::FactorSet& factors() const override { return factors_; }
  std::size_t point_count() const override { return 0; }
  const Eigen::MatrixXd& gains() const override { return point_.gains; }
  const studies::LinearEngine* linear_engine() const override { return engine_.get(); }
  std::string against_linear() const override {
    return factors_.nonlinear().empty()
               ? std::string()
               : "not linear in what is drawn: " + factors_.nonlinear().front();
  }
  double measuring_uncertainty(std::size_t) const override { return 0.0; }
  std::optional<LinearView> linear_view(std::size_t) const override {
    const auto values = [this](std::span<const double> weights) {
      const std::size_t columns = factors_.columns().size();
      std::vector<double> lengths(columns == 0 ? 0 : weights.size() / columns);
      for (std::size_t i = 0; i < lengths.size(); ++i) {
        lengths[i] = point_.length(weights.subspan(i * columns, columns));
      }
      return lengths;
    };
    return LinearView{point_.gains, values};
  }
  const studies::VolumetricPoint& point() const { return point_; }

  std::vector<DrawOutcome> full(std::span<const DrawnMachine> draws,
                                const EvaluationRequest& request) const override {
    std::vector<DrawOutcome> outcomes(draws.size());
    tbb::parallel_for(std::size_t{0}, draws.size(), [&](std::size_t i) {
      const auto errors = errors_of(factors_, target_.machine, draws[i], request.scale);
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
  Vec3 tip_of(const GeometricErrors& errors) const {
    return kinematics::ForwardChain(target_.machine, errors, target_.tool_length)
        .table_from_tool(target_.at)
        .translation;
  }

  const VolumetricTarget& target_;
  studies::FactorSet factors_;
  studies::VolumetricPoint point_;
  Vec3 nominal_;
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
  if (volumetric == nullptr) return std::nullopt;
  const auto length = studies::exact_length(volumetric->point(), model.factors());
  if (!length) return std::nullopt;
  studies::ExactLength exact{.mean = length->mean(), .rms = length->rms()};
  for (const double p : studies::kQuantiles) {
    exact.quantiles.push_back({.p = p, .value = length->quantile(p)});
  }
  if (limit) exact.conform = length->probability(*limit);
  return exact;
}

}  // namespace frustum::app
