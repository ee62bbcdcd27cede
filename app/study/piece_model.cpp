#include "app/study/piece_model.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "metrology/cmm.hpp"
#include "metrology/plan/strategy.hpp"
#include "studies/engine/linear_engine.hpp"
#include "trials/surface_gain.hpp"

namespace frustum::app {
namespace {

using kinematics::GeometricErrors;

std::string joined(const Diagnostics& problems) {
  std::string text;
  for (const Diagnostic& d : problems) {
    if (d.severity != Severity::error) continue;
    text += (text.empty() ? "" : "; ") + d.message;
  }
  return text;
}

trials::TrialOptions options_of(const Job& job) {
  trials::TrialOptions options;
  options.path_bound = job.path_bound;
  options.time_law = job.controller.time_law;
  options.servo_lag = job.controller.servo_lag;
  options.find_collisions = false;
  return options;
}

// Deviation from the nominal where there is one, um or urad.
double shown(const metrology::CharacteristicResult& c) {
  const double nominal = c.nominal ? metrology::internal_value(*c.nominal, c.unit) : 0.0;
  const double scale = metrology::is_angle(c) ? kUradPerRad : kUmPerMm;
  return (metrology::internal_value(c) - nominal) * scale;
}

std::vector<double> values_of(const metrology::Measurement& measurement) {
  std::vector<double> values;
  for (const auto& c : measurement.characteristics) values.push_back(shown(c));
  return values;
}

class PieceModel final : public StudyModel {
 public:
  PieceModel(const StudyFile& study, trials::CommandedPiece commanded, studies::FactorSet factors,
             trials::Trial middle)
      : study_(study),
        commanded_(std::move(commanded)),
        factors_(std::move(factors)),
        middle_(std::move(middle)) {}

  // The gains of all columns; where they cannot be had, why.
  void find_gains() {
    std::vector<trials::Parameter> columns;
    for (const studies::Column& column : factors_.columns()) {
      columns.push_back({column.name, false, column.unit});
    }
    const auto gains = trials::surface_gains(study_.machine(), study_.job->piece, middle_, columns);
    if (!gains) {
      against_linear_ = "the gains of the surface are not known: " + joined(gains.error());
      return;
    }
    gains_ = gains->odd * kUmPerMm;
    // What a face cut by a leaning end of a cutter adds, for the largest errors of the laws.
    const std::vector<double> largest = factors_.largest_weights();
    const Eigen::Map<const Eigen::VectorXd> most(largest.data(),
                                                 static_cast<Eigen::Index>(largest.size()));
    constexpr double kNothing = 1e-6;  // mm: below a nanometre nothing is seen of it
    if ((gains->even.cwiseAbs() * most).maxCoeff() > kNothing) {
      against_linear_ = "a face is cut by the leaning end of a cutter, which is not linear";
    }
  }

  const studies::FactorSet& factors() const override { return factors_; }
  std::size_t point_count() const override {
    std::size_t count = 0;
    for (const auto& feature : middle_.measurement.features) count += feature.points.size();
    return count;
  }
  const Eigen::MatrixXd& gains() const override { return gains_; }
  std::string against_linear() const override {
    if (!factors_.nonlinear().empty()) {
      return "not linear in what is drawn: " + factors_.nonlinear().front();
    }
    if (study_.measurement.noise) return "each draw is measured with the noise of the CMM";
    return against_linear_;
  }
  std::optional<LinearView> linear_view(std::size_t characteristic) const override {
    const auto linear = linearised(characteristic);
    if (!linear) return std::nullopt;
    const auto engine = std::make_shared<studies::LinearEngine>(
        factors_, studies::LinearModel{.characteristics = {*linear}});
    LinearView view{.values = [engine](std::span<const double> weights) {
      return engine->evaluate_weights(weights);
    }};
    if (const auto* range = std::get_if<studies::LinearRange>(&linear->of)) {
      view.gains = range->gains;
    } else {
      view.gains = std::get<studies::LinearSum>(linear->of).gains.transpose();
    }
    return view;
  }
  double measuring_uncertainty(std::size_t characteristic) const override {
    const auto measured = evaluated(Eigen::VectorXd(), study_.job->cmm);
    if (!measured) return 0.0;
    const auto& c = measured->characteristics.at(characteristic);
    return metrology::internal_value(c.standard_uncertainty, c.unit) *
           (metrology::is_angle(c) ? kUradPerRad : kUmPerMm);
  }

  std::vector<std::string> program_hashes() const override {
    std::vector<std::string> hashes;
    for (const trials::ProgramFile& file : commanded_.program_files) hashes.push_back(file.sha256);
    return hashes;
  }

  std::vector<DrawOutcome> full(std::span<const DrawnMachine> draws,
                                const EvaluationRequest& request) const override {
    std::vector<DrawOutcome> outcomes(draws.size());
    tbb::parallel_for(std::size_t{0}, draws.size(),
                      [&](std::size_t i) { outcomes[i] = whole_trial(draws[i], request); });
    return outcomes;
  }

  std::vector<DrawOutcome> linear(std::span<const DrawnMachine> draws,
                                  const EvaluationRequest& request) const override {
    std::vector<DrawOutcome> outcomes(draws.size());
    tbb::parallel_for(std::size_t{0}, draws.size(),
                      [&](std::size_t i) { outcomes[i] = moved(draws[i], request); });
    return outcomes;
  }

 private:
  Eigen::VectorXd weights_of(const DrawnMachine& machine, double scale) const {
    Eigen::VectorXd weights(static_cast<Eigen::Index>(factors_.columns().size()));
    factors_.weights(machine.values, {weights.data(), factors_.columns().size()});
    return scale * weights;
  }

  Result<GeometricErrors> errors_of(const DrawnMachine& machine, double scale) const {
    if (scale == 1.0) return factors_.errors_at(study_.machine(), machine.values);
    const Eigen::VectorXd weights = weights_of(machine, scale);
    GeometricErrors errors = factors_.fixed();
    for (std::size_t j = 0; j < factors_.columns().size(); ++j) {
      errors = errors.plus(factors_.columns()[j].unit, weights[static_cast<Eigen::Index>(j)]);
    }
    return errors;
  }

  DrawOutcome whole_trial(const DrawnMachine& machine, const EvaluationRequest& request) const {
    DrawOutcome outcome;
    const Job& job = *study_.job;
    metrology::CmmModel cmm;
    if (study_.measurement.noise) {
      cmm = job.cmm;
      cmm.draw = machine.draw;
    }
    const auto errors = errors_of(machine, request.scale);
    const auto trial = errors ? trials::run_trial(job.machine, *errors, job.piece, commanded_, cmm,
                                                  options_of(job))
                              : Result<trials::Trial>(errors.error());
    if (!trial) {
      outcome.failure = joined(trial.error());
      return outcome;
    }
    outcome.values = values_of(trial->measurement);
    if (request.points) outcome.points = deviations_of(trial->measurement);
    return outcome;
  }

  // From the planned points to the measured ones, along the planned normals.
  std::vector<double> deviations_of(const metrology::Measurement& measurement) const {
    std::vector<double> deviations;
    for (const auto& feature : measurement.features) {
      const auto* planned = metrology::find_feature(study_.job->piece.plan, feature.name);
      if (planned == nullptr) continue;
      const auto places = metrology::planned_points(*planned);
      for (std::size_t i = 0; i < std::min(places.size(), feature.points.size()); ++i) {
        const Vec3 at = measurement.workpiece_from_datum.point(feature.points[i].point);
        const Vec3 normal = places[i].normal;
        deviations.push_back(normal.dot(at - places[i].point) * kUmPerMm);
      }
    }
    return deviations;
  }

  // The points of the machine in the middle, moved along their normals by so many um.
  Result<metrology::Measurement> evaluated(const Eigen::VectorXd& moves,
                                           const metrology::CmmModel& cmm) const {
    const metrology::Measurement& middle = middle_.measurement;
    std::vector<metrology::FeaturePoints> features;
    Eigen::Index row = 0;
    for (const auto& feature : middle.features) {
      metrology::FeaturePoints points{feature.name, {}, {}};
      for (const metrology::MeasuredPoint& p : feature.points) {
        const double move = moves.size() == 0 ? 0.0 : moves[row++] / kUmPerMm;
        points.points.push_back(middle.workpiece_from_datum.point(p.point + move * p.normal));
        points.sections.push_back(p.section);
      }
      features.push_back(std::move(points));
    }
    return metrology::evaluate(study_.job->piece.plan, features, metrology::PointMeaning::surface,
                               cmm);
  }

  // By differences of the evaluation: the deviations that make a form, or a value of either sign.
  // What the first draws then do not agree with is neither.
  std::optional<studies::LinearCharacteristic> linearised(std::size_t characteristic) const {
    const auto base = evaluated(Eigen::VectorXd(), {});
    if (!base || gains_.cols() == 0) return std::nullopt;
    const auto deviations = [&](const metrology::Measurement& measurement) -> Eigen::VectorXd {
      const auto& c = measurement.characteristics.at(characteristic);
      if (study_.characteristics[characteristic].both_sides) {
        return Eigen::VectorXd::Constant(1, shown(c));
      }
      return kUmPerMm *
             Eigen::Map<const Eigen::VectorXd>(c.plot_deviation.data(),
                                               static_cast<Eigen::Index>(c.plot_deviation.size()));
    };
    const Eigen::VectorXd nominal = deviations(*base);
    if (nominal.size() == 0) return std::nullopt;
    Eigen::MatrixXd gains(nominal.size(), gains_.cols());
    std::vector<char> sound(static_cast<std::size_t>(gains_.cols()), 1);
    tbb::parallel_for(Eigen::Index{0}, gains_.cols(), [&](Eigen::Index j) {
      const double most = gains_.col(j).cwiseAbs().maxCoeff();
      gains.col(j).setZero();
      if (!(most > 0.0)) return;
      // One um: small against the part, large against the fits' rounding.
      const auto moved = evaluated(gains_.col(j) / most, {});
      const Eigen::VectorXd there = moved ? deviations(*moved) : Eigen::VectorXd();
      sound[static_cast<std::size_t>(j)] = there.size() == nominal.size() ? 1 : 0;
      if (there.size() == nominal.size()) gains.col(j) = (there - nominal) * most;
    });
    if (!std::ranges::all_of(sound, [](char c) { return c == 1; })) return std::nullopt;
    const StudyCharacteristic& of = study_.characteristics[characteristic];
    studies::LinearCharacteristic linear{of.name, of.unit(), {}};
    if (of.both_sides) {
      linear.of = studies::LinearSum{nominal[0], gains.row(0).transpose()};
    } else {
      linear.of = studies::LinearRange{nominal, gains};
    }
    return agrees(linear, characteristic) ? std::optional(std::move(linear)) : std::nullopt;
  }

  bool agrees(const studies::LinearCharacteristic& linear, std::size_t characteristic) const {
    std::vector<double> values(factors_.variables().size());
    for (std::uint32_t draw = 0; draw < 3; ++draw) {
      factors_.draw(study_.seed, draw, values);
      const Eigen::VectorXd weights = weights_of({draw, values}, 1.0);
      const auto whole = evaluated(gains_ * weights, {});
      if (!whole) return false;
      const double value = shown(whole->characteristics.at(characteristic));
      // Second order and the fits' own: a tenth of what a share has to say.
      constexpr double kRelative = 0.01, kAbsolute = 0.02;  // um or urad
      if (std::abs(studies::value_of(linear, weights) - value) >
          kRelative * std::abs(value) + kAbsolute) {
        return false;
      }
    }
    return true;
  }

  DrawOutcome moved(const DrawnMachine& machine, const EvaluationRequest& request) const {
    DrawOutcome outcome;
    const Eigen::VectorXd moves = gains_ * weights_of(machine, request.scale);
    outcome.largest_move = moves.size() == 0 ? 0.0 : moves.cwiseAbs().maxCoeff();
    const auto measurement = evaluated(moves, {});
    if (!measurement) {
      outcome.failure = joined(measurement.error());
      return outcome;
    }
    outcome.values = values_of(*measurement);
    if (request.points) {
      outcome.points = deviations_of(middle_.measurement);
      for (std::size_t i = 0; i < outcome.points.size(); ++i) {
        outcome.points[i] += moves[static_cast<Eigen::Index>(i)];
      }
    }
    return outcome;
  }

  const StudyFile& study_;
  trials::CommandedPiece commanded_;
  studies::FactorSet factors_;
  trials::Trial
      middle_;  // of the machine with the errors that are not drawn, by a CMM without errors
  Eigen::MatrixXd gains_{};
  std::string against_linear_{};
};

// The nominal machine must make a good part, or the study says nothing about machines.
Diagnostics problems_of_nominal(const StudyFile& study, const trials::Trial& trial) {
  Diagnostics problems;
  for (Diagnostic d : trial.wrong_cuts) {
    d.severity = Severity::error;
    problems.push_back(std::move(d));
  }
  const std::vector<double> values = values_of(trial.measurement);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const StudyCharacteristic& c = study.characteristics[i];
    if (c.conforms(values[i])) continue;
    problems.push_back(
        error("nominal-fails"_id,
              fmt::format("the machine without errors makes {} = {:.4g} {}, limit {:g} {}", c.name,
                          values[i], c.unit(), *c.limit, c.unit()),
              "check program, plan and limits: frustum run shows what is wrong"));
  }
  return problems;
}

}  // namespace

Result<std::unique_ptr<StudyModel>> make_piece_model(const StudyFile& study) {
  const Job& job = *study.job;
  auto commanded = trials::command_piece(job.machine, job.piece);
  if (!commanded) return std::move(commanded).error();
  const auto spans = trials::error_spans(job.piece, *commanded);
  if (!spans) return spans.error();
  auto factors = studies::FactorSet::make(job.machine, study.errors,
                                          {.read_as = study.read_as,
                                           .scale = study.scale,
                                           .correlated = study.correlated,
                                           .spans = *spans});
  if (!factors) return std::move(factors).error();
  const Result<trials::Trial> nominal =
      trials::run_trial(job.machine, GeometricErrors{}, job.piece, *commanded, {}, options_of(job));
  if (!nominal) return nominal.error();
  if (auto problems = problems_of_nominal(study, *nominal); !problems.empty()) return problems;
  auto middle = factors->has_fixed_errors()
                    ? trials::run_trial(job.machine, factors->fixed(), job.piece, *commanded, {},
                                        options_of(job))
                    : nominal;
  if (!middle) return std::move(middle).error();
  auto model = std::make_unique<PieceModel>(study, *std::move(commanded), *std::move(factors),
                                            *std::move(middle));
  model->find_gains();
  return std::unique_ptr<StudyModel>(std::move(model));
}

}  // namespace frustum::app
