#include "app/job/identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "app/job/trial_run.hpp"
#include "calibration/design/step_geometry.hpp"
#include "calibration/identify/joint_observations.hpp"
#include "calibration/identify/refinement.hpp"
#include "trials/trial.hpp"

namespace frustum::app {
namespace {

using calibration::Cause;
using calibration::MeasuredPiece;
using calibration::Unknown;

// Which step patterns, not measured yet, would identify the rest; nothing when the machine cuts
// none.
Result<std::optional<Remedy>> remedy_for(const Study& study,
                                         const calibration::Observations& measured,
                                         const UnknownCauses& all) {
  const auto catalogue = calibration::step_catalogue(study.machine(), all.unknowns, all.causes,
                                                     study.cmm.value_or(ordinary_cmm()));
  // On a machine that cuts no step patterns there is nothing to suggest.
  if (!catalogue) return std::optional<Remedy>();
  // Patterns do not answer to the balls of motion tests.
  const auto unknowns = static_cast<Eigen::Index>(measured.unknowns.size());
  std::set<std::string> cut;
  for (const calibration::Row& row : measured.rows) cut.insert(row.group);
  std::vector<calibration::Candidate> candidates;
  for (std::size_t i = 0; i < catalogue->patterns.size(); ++i) {
    if (cut.contains(catalogue->patterns[i].name)) continue;
    calibration::Candidate candidate = catalogue->candidate(i);
    const Eigen::Index own = candidate.gain.cols();
    candidate.gain.conservativeResize(Eigen::NoChange, unknowns);
    candidate.gain.rightCols(unknowns - own).setZero();
    candidates.push_back(std::move(candidate));
  }
  const auto separation =
      calibration::separating(measured, candidates, {study.floor_length, study.floor_angle});
  if (!separation) return separation.error();
  Remedy remedy;
  if (separation->smallest) {
    for (const std::size_t i : *separation->smallest) {
      remedy.patterns.push_back(candidates[i].name);
    }
  }
  for (const auto& u : catalogue->unreachable) remedy.unreachable.push_back(u.pattern);
  return std::optional(std::move(remedy));
}

double known_value(const Study& study, const std::string& name) {
  for (const KnownError& k : study.known) {
    if (k.name == name) return k.value;
  }
  return 0.0;
}

Result<calibration::Recipe> recipe_of(const Study& study,
                                      const calibration::RecipeVariant& variant) {
  std::vector<calibration::StepMeasurement> measured;
  for (const StudyPart& part : study.parts) {
    const auto steps =
        calibration::step_measurements(part.job.piece.plan, calibration::mean_of(part.measured));
    measured.insert(measured.end(), steps.begin(), steps.end());
  }
  const calibration::KnownSquareness known{known_value(study, "gamma_YX"),
                                           known_value(study, "alpha_ZY"),
                                           known_value(study, "beta_ZX")};
  return study.recipe == RecipeChoice::case_1
             ? calibration::recipe_case_1(measured, known, variant)
             : calibration::recipe_case_2(measured, known, variant);
}

// A squareness that the tests see and that the study neither looks for nor states would be taken
// for zero, and end up in the errors of the rotary axes.
std::optional<Diagnostics> squareness_not_said(const Study& study, const UnknownCauses& all) {
  const auto& machine = study.machine();
  std::set<std::string> said;
  for (const Unknown& unknown : all.unknowns) {
    const auto alias = machine.aliases().find(unknown.name);
    said.insert(alias == machine.aliases().end() ? unknown.name : alias->second.error.text());
  }
  Diagnostics problems;
  for (const char* name : {"EC0Y", "EA0Z", "EB0Z"}) {
    const auto error_name = *kinematics::ErrorName::parse(name);
    if (said.contains(name) || machine.joint(error_name.axis) == nullptr ||
        machine.refused(error_name)) {
      continue;
    }
    const auto cause = trials::Parameter::named(machine, name);
    if (!cause) continue;
    const auto seen = calibration::observations_of(
        machine, study.motions, {{.name = name, .angular = true}}, {{*cause, std::nullopt}});
    constexpr double kSeen = 1e-3;  // mm per rad: a nanometre at a milliradian
    if (!seen || seen->observations.gain.cwiseAbs().maxCoeff() < kSeen) continue;
    problems.push_back(error(
        "squareness-not-said"_id,
        fmt::format("the motion tests depend on the squareness {}, which is neither unknown nor "
                    "known: taken for zero it would go into the errors of the rotary axes",
                    name),
        fmt::format("add it to unknown.errors, or state known.{} = {{ value = \"0 urad\", "
                    "uncertainty = \"5 urad\" }}",
                    name)));
  }
  if (problems.empty()) return std::nullopt;
  for (Diagnostic& each : problems) each.file = study.file.string();
  return problems;
}

Result<calibration::Refinement> estimate(const Study& study,
                                         const calibration::PieceObservations& pieces) {
  calibration::RefineOptions options;
  options.identify.floor = {study.floor_length, study.floor_angle};
  options.identify.degrees_of_freedom = pieces.degrees_of_freedom;
  if (study.refine) return calibration::refine(pieces.observations, pieces.model, options);
  calibration::Observations linear = pieces.observations;
  linear.values -= pieces.without_unknowns;
  auto identification = calibration::identify(linear, options.identify);
  if (!identification) return std::move(identification).error();
  return calibration::Refinement{*std::move(identification), {}};
}

}  // namespace

metrology::CmmModel ordinary_cmm() {
  metrology::CmmModel cmm;
  cmm.e0_mm = 0.5e-3;
  cmm.length_per_error = 600.0;
  return cmm;
}

void add_tool_radius(const Study& study, UnknownCauses& all) {
  if (study.parts.empty()) return;
  const trials::Parameter radius{std::string(trials::kToolRadius), false, std::nullopt};
  const bool is_listed = std::any_of(all.unknowns.begin(), all.unknowns.end(),
                                     [&](const Unknown& u) { return u.name == radius.name; });
  if (study.tool_radius == ToolRadius::exact || is_listed) return;
  if (study.tool_radius == ToolRadius::common) {
    all.unknowns.push_back({.name = radius.name});
    all.causes.push_back({radius, std::nullopt});
    return;
  }
  for (std::size_t i = 0; i < study.parts.size(); ++i) {
    all.unknowns.push_back({.name = fmt::format("{} of {}", radius.name, study.parts[i].name)});
    all.causes.push_back({radius, i});
  }
}

Result<std::vector<MeasuredPiece>> pieces_of(const Study& study) {
  std::vector<MeasuredPiece> pieces;
  for (const StudyPart& part : study.parts) {
    const Job& job = part.job;
    auto commanded = trials::command_piece(job.machine, job.piece);
    if (!commanded) return commanded.error();
    const auto base = trials::errors_for(job.machine, job.errors, job.piece, *commanded);
    if (!base) return base.error();
    MeasuredPiece piece{part.name,
                        job.piece,
                        *base,
                        part.measured,
                        study.cmm,
                        path_options_of(job),
                        std::make_shared<const trials::CommandedPiece>(*std::move(commanded))};
    if (!piece.cmm && job.cmm.e0_mm > 0.0) piece.cmm = job.cmm;
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

Result<UnknownCauses> unknown_causes(const kinematics::Machine& machine,
                                     const std::vector<std::string>& names,
                                     const std::vector<KnownError>& known) {
  const auto parameters = trials::parameters_named(machine, names);
  if (!parameters) return parameters.error();
  UnknownCauses all;
  for (const trials::Parameter& parameter : *parameters) {
    Unknown unknown{.name = parameter.name, .angular = parameter.angular};
    const auto at = std::find_if(known.begin(), known.end(),
                                 [&](const KnownError& k) { return k.name == parameter.name; });
    if (at != known.end()) {
      if (at->uncertainty > 0.0) {
        unknown.prior = calibration::Prior{at->value, at->uncertainty};
      } else {
        unknown.fixed = at->value;
      }
    }
    all.unknowns.push_back(std::move(unknown));
    all.causes.push_back({parameter, std::nullopt});
  }
  return all;
}

Result<calibration::PieceObservations> observations_of_study(const Study& study,
                                                             const UnknownCauses& all) {
  calibration::PieceObservations pieces;
  if (!study.parts.empty()) {
    const auto measured = pieces_of(study);
    if (!measured) return measured.error();
    auto of_parts =
        calibration::observations_of(study.machine(), *measured, all.unknowns, all.causes);
    if (!of_parts) return of_parts.error();
    pieces = *std::move(of_parts);
  }
  if (study.motions.empty()) return pieces;
  if (auto problem = squareness_not_said(study, all)) return *std::move(problem);
  std::vector<Unknown> unknowns = all.unknowns;
  const auto balls = calibration::ball_unknowns(study.motions);
  unknowns.insert(unknowns.end(), balls.begin(), balls.end());
  auto motions = calibration::observations_of(study.machine(), study.motions, unknowns, all.causes);
  if (!motions) return motions.error();
  return calibration::joint_observations(std::move(pieces), *std::move(motions));
}

bool is_answered(const StudyResult& result) {
  const auto& estimates = result.identification.estimates;
  return std::all_of(estimates.begin(),
                     estimates.begin() + static_cast<std::ptrdiff_t>(result.asked),
                     [](const calibration::Estimate& e) { return e.value.has_value(); });
}

Result<StudyResult> identify_study(const Study& study) {
  auto all = unknown_causes(study.machine(), study.unknowns, study.known);
  if (!all) return std::move(all).error();
  add_tool_radius(study, *all);
  auto observations = observations_of_study(study, *all);
  if (!observations) return observations.error();
  auto refined = estimate(study, *observations);
  if (!refined) return std::move(refined).error();
  if (!study.motions.empty() && !refined->identification.agreement.rejected) {
    // What the tests do not see of their mountings shows by the errors that were found; of a model
    // that does not explain the readings those say nothing.
    const auto unseen =
        unseen_mounting_covariance(study.motions, observations->observations.unknowns, all->causes,
                                   refined->identification.working_point);
    if (!unseen) return unseen.error();
    const Eigen::Index rows = unseen->rows();
    observations->observations.covariance.bottomRightCorner(rows, rows) += *unseen;
    refined = estimate(study, *observations);
    if (!refined) return std::move(refined).error();
  }
  StudyResult result;
  result.identification = std::move(refined->identification);
  result.asked = study.unknowns.size();
  result.mountings = found_mountings(study.motions, observations->observations.unknowns,
                                     all->causes, result.identification.working_point);
  result.changes = std::move(refined->changes);
  result.left_out = observations->left_out;
  auto shares = calibration::information_shares(observations->observations,
                                                {.floor = {study.floor_length, study.floor_angle}});
  if (!shares) return std::move(shares).error();
  result.shares = *std::move(shares);
  if (!result.identification.observability.complete()) {
    auto remedy = remedy_for(study, observations->observations, *all);
    if (!remedy) return std::move(remedy).error();
    result.remedy = *std::move(remedy);
  }
  if (study.recipe != RecipeChoice::none) {
    auto recipe = recipe_of(study, {});
    if (!recipe) return std::move(recipe).error();
    auto corrected = recipe_of(study, {.equation_12_corrected = true, .equation_20_with_2h = true});
    if (!corrected) return std::move(corrected).error();
    result.recipe = *std::move(recipe);
    result.corrected_recipe = *std::move(corrected);
  }
  return result;
}

}  // namespace frustum::app
