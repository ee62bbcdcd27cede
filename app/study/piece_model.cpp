#include "app/study/piece_model.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "app/job/trial_run.hpp"
#include "app/study/linear_piece.hpp"
#include "app/study/place_in_file.hpp"
#include "core/units.hpp"
#include "kinematics/path/approach_direction.hpp"
#include "metrology/characteristic/datum_system.hpp"
#include "metrology/cmm.hpp"
#include "metrology/plan/strategy.hpp"
#include "studies/engine/linear_engine.hpp"
#include "trials/population/population.hpp"

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
  trials::TrialOptions options = path_options_of(job);
  options.find_collisions = false;
  return options;
}

class PieceModel final : public StudyModel {
 public:
  PieceModel(const StudyFile& study, trials::CommandedPiece commanded, studies::FactorSet factors,
             trials::Trial middle)
      : study_(study),
        commanded_(std::move(commanded)),
        factors_(std::move(factors)),
        middle_(std::move(middle)),
        linear_(study_, factors_, middle_) {}

  const studies::FactorSet& factors() const override { return factors_; }
  std::size_t point_count() const override {
    std::size_t count = 0;
    for (const auto& feature : middle_.measurement.features) count += feature.points.size();
    return count;
  }
  const Eigen::MatrixXd& gains() const override { return linear_.reach_gains(); }
  const studies::LinearEngine* linear_engine() const override { return linear_.engine(); }
  std::string against_linear() const override {
    if (!factors_.nonlinear().empty()) {
      return "not linear in what is drawn: " + factors_.nonlinear().front();
    }
    if (study_.measurement.noise) return "each draw is measured with the noise of the CMM";
    return linear_.against();
  }
  std::optional<LinearView> linear_view(std::size_t characteristic) const override {
    const auto& linear = linear_.characteristic(characteristic);
    if (!linear) return std::nullopt;
    const auto engine = std::make_shared<studies::LinearEngine>(
        factors_, studies::LinearModel{.characteristics = {*linear}});
    LinearView view{.values = [engine](std::span<const double> weights) {
      return engine->evaluate_weights(weights);
    }};
    view.gains = studies::gains_of(*linear);
    return view;
  }
  double measuring_uncertainty(std::size_t characteristic) const override {
    const auto measured = linear_.judged_by(study_.job->cmm);
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

  std::string about_full() const override {
    if (study_.keep_points && study_.measurement.noise) {
      return "every draw is a whole trial: its single points have the noise of the CMM";
    }
    if (population() != nullptr) return {};
    return "every draw is a whole trial: " + against_following_;
  }

  std::vector<DrawOutcome> full(std::span<const DrawnMachine> draws,
                                const EvaluationRequest& request) const override {
    // Single points with the CMM's noise are those of a trial.
    const bool is_trial = request.points && study_.measurement.noise;
    if (!is_trial && population() != nullptr) return followed(draws, request);
    std::vector<DrawOutcome> outcomes(draws.size());
    tbb::parallel_for(std::size_t{0}, draws.size(),
                      [&](std::size_t i) { outcomes[i] = whole_trial(draws[i], request); });
    return outcomes;
  }

  std::vector<DrawOutcome> linear(std::span<const DrawnMachine> draws,
                                  const EvaluationRequest& request) const override {
    if (const auto* engine = linear_.engine()) {
      return in_lanes(*engine, factors_, draws, request.scale);
    }
    std::vector<DrawOutcome> outcomes(draws.size());
    tbb::parallel_for(std::size_t{0}, draws.size(), [&](std::size_t i) {
      outcomes[i] = linear_.moved(weights_of(factors_, draws[i], request.scale));
    });
    return outcomes;
  }
  std::vector<double> linear_points(const DrawnMachine& machine) const override {
    return linear_.points(weights_of(factors_, machine, 1.0));
  }

 private:
  // Made when the first draw asks for it; nullptr where every draw must be a whole trial.
  const trials::Population* population() const {
    std::call_once(population_once_, [this] { make_population(); });
    return population_ ? &*population_ : nullptr;
  }

  void make_population() const {
    const Job& job = *study_.job;
    if (!factors_.nonlinear().empty()) {
      against_following_ = "not linear in what is drawn: " + factors_.nonlinear().front();
      return;
    }
    if (job.controller.servo_lag) {
      against_following_ = "the drives lag behind what is commanded";
      return;
    }
    if (job.dynamic_model != nullptr) {
      against_following_ = "masses and springs of the machine move the tool";
      return;
    }
    const Eigen::VectorXd mean = factors_.weight_moments().mean;
    const std::vector<double> largest = factors_.largest_weights();
    std::vector<trials::ErrorColumn> columns;
    for (const studies::Column& column : factors_.columns()) {
      const std::size_t j = columns.size();
      trials::ErrorColumn one;
      one.error = column.name;
      one.middle = mean[static_cast<Eigen::Index>(j)];
      one.most = largest[j];
      one.unit = column.unit;
      columns.push_back(std::move(one));
    }
    auto made =
        trials::Population::make(job.machine, asked_of_population(), commanded_,
                                 trials::PopulationLaws::of(factors_.fixed(), std::move(columns)),
                                 {.path_bound = job.path_bound, .refuse_whole = true});
    if (made) {
      population_ = *std::move(made);
    } else {
      against_following_ = joined(made.error());
    }
  }

  // The piece with the features of the plan that a characteristic or a datum needs. Kept points are
  // those of all; noise belongs to the number of a feature.
  programs::TestPiece asked_of_population() const {
    programs::TestPiece piece = study_.job->piece;
    metrology::InspectionPlan& plan = piece.plan;
    if (study_.keep_points || study_.measurement.noise || !plan.frames.empty()) return piece;
    const metrology::InspectionPlan whole = plan;
    std::erase_if(plan.features, [&](const metrology::PlannedFeature& feature) {
      const auto names_it = [&](const metrology::PlannedCharacteristic& c) {
        return std::ranges::find(c.features, feature.name) != c.features.end();
      };
      return !metrology::is_datum_feature(whole, feature) &&
             std::ranges::none_of(whole.characteristics, names_it);
    });
    return piece;
  }

  std::vector<DrawOutcome> followed(std::span<const DrawnMachine> draws,
                                    const EvaluationRequest& request) const {
    std::vector<trials::Weights> weights;
    for (const DrawnMachine& machine : draws) {
      const Eigen::VectorXd of_draw = weights_of(factors_, machine, request.scale);
      weights.emplace_back(of_draw.begin(), of_draw.end());
    }
    trials::EvaluateOptions options{.travels = request.points};
    if (study_.measurement.noise) {
      options.cmm = [&](std::size_t i) {
        metrology::CmmModel cmm = study_.job->cmm;
        cmm.draw = draws[i].draw;
        return cmm;
      };
    }
    std::vector<DrawOutcome> outcomes;
    for (const trials::PopulationMember& member : population_->evaluate(weights, options)) {
      outcomes.push_back(outcome_of(member));
    }
    return outcomes;
  }

  DrawOutcome outcome_of(const trials::PopulationMember& member) const {
    DrawOutcome outcome;
    if (!member.failure.empty()) {
      outcome.failure = joined(member.failure);
      return outcome;
    }
    const auto& characteristics = middle_.measurement.characteristics;
    for (std::size_t i = 0; i < member.values.size(); ++i) {
      outcome.values.push_back(shown_value(characteristics[i], member.values[i]));
    }
    auto travel = member.travels.begin();
    for (const auto& feature : study_.job->piece.plan.features) {
      if (travel == member.travels.end()) break;
      for (const metrology::PlannedPoint& planned : metrology::planned_points(feature)) {
        const Vec3 at =
            member.workpiece_from_datum.point(planned.point + *travel++ * planned.normal);
        outcome.points.push_back(planned.normal.dot(at - planned.point) * kUmPerMm);
      }
    }
    return outcome;
  }

  DrawOutcome whole_trial(const DrawnMachine& machine, const EvaluationRequest& request) const {
    DrawOutcome outcome;
    const Job& job = *study_.job;
    metrology::CmmModel cmm;
    if (study_.measurement.noise) {
      cmm = job.cmm;
      cmm.draw = machine.draw;
    }
    const auto errors = errors_of(factors_, study_.machine(), machine, request.scale);
    const auto trial = errors ? trials::run_trial(job.machine, *errors, job.piece, commanded_, cmm,
                                                  options_of(job))
                              : Result<trials::Trial>(errors.error());
    if (!trial) {
      outcome.failure = joined(trial.error());
      return outcome;
    }
    outcome.values = shown_values(trial->measurement);
    if (request.points) outcome.points = deviations_of(job.piece.plan, trial->measurement);
    return outcome;
  }

  const StudyFile& study_;
  trials::CommandedPiece commanded_;
  studies::FactorSet factors_;
  // Of the machine with the errors that are not drawn, by a CMM without errors.
  trials::Trial middle_;
  LinearPiece linear_;
  mutable std::once_flag population_once_{};
  mutable std::optional<trials::Population> population_{};
  mutable std::string against_following_{};
};

// The errors that are not drawn. A path knows from which side an axis has come only where an error
// depends on it: reversals have a part of a picometre, or of a picoradian.
GeometricErrors errors_of_middle(const studies::FactorSet& factors) {
  constexpr double kTrace = 1e-9;
  GeometricErrors errors = factors.fixed();
  for (const studies::Column& column : factors.columns()) {
    if (kinematics::ApproachTracker(column.unit).follows_any()) {
      errors = errors.plus(column.unit, kTrace);
    }
  }
  return errors;
}

// The nominal machine must make a good part, or the study says nothing about machines.
Diagnostics problems_of_nominal(const StudyFile& study, const trials::Trial& trial) {
  Diagnostics problems;
  for (Diagnostic d : trial.wrong_cuts) {
    d.severity = Severity::error;
    problems.push_back(std::move(d));
  }
  const std::vector<double> values = shown_values(trial.measurement);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const StudyCharacteristic& c = study.characteristics[i];
    if (c.conforms(values[i])) continue;
    const Diagnostic fails =
        error("nominal-fails"_id,
              fmt::format("the machine without errors makes {} = {:.4g} {}, limit {:g} {}", c.name,
                          values[i], c.unit(), *c.limit, c.unit()),
              "check program, plan and limits: frustum run shows what is wrong");
    auto placed = at_key(study.file, "limits", c.name, fails);
    if (!placed) {
      placed = at_key_of(study.job->plan_file, "characteristic", c.name, "tolerance", fails);
    }
    problems.push_back(placed.value_or(fails));
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
  const GeometricErrors undrawn = errors_of_middle(*factors);
  auto middle = trials::run_trial(job.machine, undrawn, job.piece, *commanded, {}, options_of(job));
  if (!middle) return std::move(middle).error();
  return std::unique_ptr<StudyModel>(std::make_unique<PieceModel>(
      study, *std::move(commanded), *std::move(factors), *std::move(middle)));
}

}  // namespace frustum::app
