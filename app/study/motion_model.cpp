#include "app/study/motion_model.hpp"

#include <tbb/parallel_for.h>

#include "core/units.hpp"

namespace frustum::app {
namespace {

using kinematics::GeometricErrors;

Eigen::Map<const Eigen::VectorXd> as_vector(const std::vector<double>& numbers) {
  return {numbers.data(), static_cast<Eigen::Index>(numbers.size())};
}

// mm per mm or rad, a column a weight.
Eigen::MatrixXd reading_gains_of(const DrawnTest& test, const studies::FactorSet& factors) {
  const auto gain = [&](const studies::Column& column) -> Eigen::VectorXd {
    constexpr double kStep = 1e-4;
    const auto more = test.readings(factors.fixed().plus(column.unit, kStep));
    const auto less = test.readings(factors.fixed().plus(column.unit, -kStep));
    return (as_vector(more) - as_vector(less)) / (2.0 * kStep);
  };
  const std::size_t columns = factors.columns().size();
  std::vector<Eigen::VectorXd> gains(columns);
  tbb::parallel_for(std::size_t{0}, columns,
                    [&](std::size_t j) { gains[j] = gain(factors.columns()[j]); });
  const auto rows = static_cast<Eigen::Index>(test.readings(factors.fixed()).size());
  Eigen::MatrixXd all(rows, static_cast<Eigen::Index>(columns));
  for (std::size_t j = 0; j < columns; ++j) all.col(static_cast<Eigen::Index>(j)) = gains[j];
  return all;
}

// What is left of each column where the vectors of `basis` are taken out of it.
Eigen::MatrixXd without(const std::vector<std::vector<double>>& basis, Eigen::MatrixXd gains) {
  std::vector<Eigen::VectorXd> unit;  // orthonormal, by two passes of Gram and Schmidt
  for (const auto& numbers : basis) {
    Eigen::VectorXd v = as_vector(numbers);
    const double length = v.norm();
    for (int pass = 0; pass < 2; ++pass) {
      for (const Eigen::VectorXd& u : unit) v -= u.dot(v) * u;
    }
    if (v.norm() > 1e-9 * length) unit.push_back(v.normalized());
  }
  for (const Eigen::VectorXd& u : unit) gains -= u * (u.transpose() * gains);
  return gains;
}

class MotionModel final : public StudyModel {
 public:
  MotionModel(const StudyFile& study, studies::FactorSet factors)
      : test_(study.motion->test),
        machine_(study.machine()),
        instrument_(study.motion->setup->instrument),
        factors_(std::move(factors)),
        middle_(test_.readings(factors_.fixed())),
        reading_gains_(reading_gains_of(test_, factors_)),
        gains_(kUmPerMm * reading_gains_) {
    instrument_.seed = study.seed;
    if (!study.measurement.noise) instrument_ = {};
    is_noisy_ = study.measurement.noise;
  }

  const studies::FactorSet& factors() const override { return factors_; }
  std::size_t point_count() const override { return middle_.size(); }
  const Eigen::MatrixXd& gains() const override { return gains_; }
  std::string against_linear() const override {
    if (!factors_.nonlinear().empty()) {
      return "not linear in what is drawn: " + factors_.nonlinear().front();
    }
    return is_noisy_ ? "each draw is measured with the noise of the instrument" : std::string();
  }
  double measuring_uncertainty(std::size_t) const override { return 0.0; }
  std::optional<LinearView> linear_view(std::size_t characteristic) const override {
    if (!test_.values[characteristic].of_form) return std::nullopt;
    const auto values = [this, characteristic](std::span<const double> weights) {
      const std::size_t columns = factors_.columns().size();
      std::vector<double> found(columns == 0 ? 0 : weights.size() / columns);
      tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
        const Eigen::Map<const Eigen::VectorXd> row(weights.data() + i * columns,
                                                    static_cast<Eigen::Index>(columns));
        const auto all = test_.evaluate(moved(row));
        found[i] = all ? (*all)[characteristic] : 0.0;
      });
      return found;
    };
    return LinearView{without(test_.unseen_by_forms, gains_), values};
  }

  std::vector<DrawOutcome> full(std::span<const DrawnMachine> draws,
                                const EvaluationRequest& request) const override {
    std::vector<DrawOutcome> outcomes(draws.size());
    tbb::parallel_for(std::size_t{0}, draws.size(), [&](std::size_t i) {
      const auto errors = errors_of(factors_, machine_, draws[i], request.scale);
      if (errors) {
        outcomes[i] = outcome_of(test_.readings(*errors), draws[i].draw, request);
      } else {
        outcomes[i].failure = errors.error().front().message;
      }
    });
    return outcomes;
  }

  std::vector<DrawOutcome> linear(std::span<const DrawnMachine> draws,
                                  const EvaluationRequest& request) const override {
    std::vector<DrawOutcome> outcomes(draws.size());
    tbb::parallel_for(std::size_t{0}, draws.size(), [&](std::size_t i) {
      const Eigen::VectorXd weights = weights_of(factors_, draws[i], request.scale);
      outcomes[i] = outcome_of(moved(weights), draws[i].draw, request);
      outcomes[i].largest_move = (gains_ * weights).cwiseAbs().maxCoeff();
    });
    return outcomes;
  }
  std::vector<double> linear_points(const DrawnMachine& machine) const override {
    return in_um(moved(weights_of(factors_, machine, 1.0)));
  }

 private:
  std::vector<double> moved(const Eigen::Ref<const Eigen::VectorXd>& weights) const {
    const Eigen::VectorXd readings = as_vector(middle_) + reading_gains_ * weights;
    return {readings.begin(), readings.end()};
  }
  DrawOutcome outcome_of(std::vector<double> readings, std::uint32_t draw,
                         const EvaluationRequest& request) const {
    readings = instruments::shown(instrument_, std::move(readings), draw);
    DrawOutcome outcome;
    if (test_.beyond) {
      if (const auto beyond = test_.beyond(readings)) {
        outcome.failure = beyond->message;
        return outcome;
      }
    }
    auto values = test_.evaluate(readings);
    if (!values) {
      outcome.failure = values.error().front().message;
      return outcome;
    }
    outcome.values = *std::move(values);
    if (request.points) outcome.points = in_um(std::move(readings));
    return outcome;
  }

  const DrawnTest& test_;
  const kinematics::Machine& machine_;
  instruments::Instrument instrument_;
  bool is_noisy_ = false;
  studies::FactorSet factors_;
  std::vector<double> middle_;  // mm
  Eigen::MatrixXd reading_gains_;
  Eigen::MatrixXd gains_;
};

}  // namespace

Result<std::unique_ptr<StudyModel>> make_motion_model(const StudyFile& study) {
  auto factors = studies::FactorSet::make(
      study.machine(), study.errors,
      {.read_as = study.read_as, .scale = study.scale, .correlated = study.correlated});
  if (!factors) return std::move(factors).error();
  // The machine without the drawn errors must be one that the bar can show.
  const DrawnTest& test = study.motion->test;
  const std::vector<double> middle = test.readings(factors->fixed());
  auto problem = test.beyond ? test.beyond(middle) : std::nullopt;
  if (!problem) {
    if (const auto values = test.evaluate(middle); !values) problem = values.error().front();
  }
  if (problem) {
    problem->file = study.motion->file.string();
    return *std::move(problem);
  }
  return std::unique_ptr<StudyModel>(std::make_unique<MotionModel>(study, *std::move(factors)));
}

}  // namespace frustum::app
