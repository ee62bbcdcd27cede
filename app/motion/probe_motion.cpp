#include "app/motion/probe_motion.hpp"

#include <fmt/format.h>

#include "app/job/trial_run.hpp"
#include "app/motion/probe_report.hpp"
#include "core/units.hpp"
#include "trials/part_gains.hpp"
#include "trials/part_program.hpp"

namespace frustum::app {
namespace {

using kinematics::AxisPositions;

Result<MotionSetup> setup_of_job(const ProbeWords& words, const Job& job,
                                 kinematics::GeometricErrors errors) {
  MotionSetup setup{.machine = job.machine,
                    .entries = job.errors,
                    .errors = std::move(errors),
                    .words = report::Wording(words.style)};
  const auto off = setup_errors_of(words.setup, "--setup");
  if (!off) return off.error();
  if (off->length != 0.0 || !off->table_ball.isZero(0.0)) {
    return error("setup-without-effect"_id,
                 "--setup of a part on its machine: ball, how far the ball of the probe is off the "
                 "programmed tip",
                 "the part is where it was cut");
  }
  setup.setup = *off;
  const auto noise = length_of_words(words.noise, "--noise");
  if (!noise) return noise.error();
  setup.instrument = {.noise = *noise / 2.0, .seed = words.seed};
  constexpr double kLongest = 1e9;  // mm, as far as axes go
  setup.tool_length = words.tool_length.value_or(
      job.piece.tools.empty() ? 0.0 : job.piece.tools.begin()->second.length.value);
  if (!(setup.tool_length >= 0.0 && setup.tool_length <= kLongest)) {
    return error("out-of-range"_id,
                 fmt::format("--tool-length {}: expected a length in mm, 0 to {:g}",
                             setup.tool_length, kLongest));
  }
  return setup;
}

// What only simulated touches have.
std::optional<Diagnostic> without_effect(const ProbeWords& words) {
  if (words.measured.empty()) return std::nullopt;
  for (const auto& [option, is_given] : {std::pair{"--noise", !words.noise.empty()},
                                         {"--setup", !words.setup.empty()},
                                         {"--pretravel", !words.lobes.constant.empty()},
                                         {"--lobe", !words.lobes.amplitude.empty()}}) {
    if (!is_given) continue;
    return error(
        "conflicting-options"_id,
        fmt::format("{} is of simulated touches, --measured gives those of a machine", option),
        "leave one of them out");
  }
  return std::nullopt;
}

Result<std::vector<AxisPositions>> poses_of_words(const ProbeWords& words, const Job& job) {
  if (words.at.empty()) return std::vector{trials::upright_position(job.machine, job.piece)};
  return pose_list(job.machine, words.at, "--at");
}

}  // namespace

Result<MotionAnswer> probe_answer(const ProbeWords& words) {
  if (auto problem = without_effect(words)) return *std::move(problem);
  const auto job = load_job(words.job, words.overrides, true);
  if (!job) return job.error();
  const auto commanded = trials::command_piece(job->machine, job->piece);
  if (!commanded) return commanded.error();
  auto errors = trials::errors_for(job->machine, job->errors, job->piece, *commanded);
  if (!errors) return errors.error();
  const auto setup = setup_of_job(words, *job, *std::move(errors));
  if (!setup) return setup.error();
  const auto poses = poses_of_words(words, *job);
  if (!poses) return poses.error();
  const auto lobes = lobes_of(words.lobes);
  if (!lobes) return lobes.error();
  const trials::PartProbe probe{
      .tool_length = setup->tool_length, .ball_off = setup->setup.ball, .lobes = *lobes};
  const auto plan = part_touches(job->machine, job->piece, *poses, probe);
  if (!plan) return plan.error();

  trials::TrialOptions options = path_options_of(*job);
  options.find_collisions = false;
  const auto trial = run_trial(job->machine, setup->errors, job->piece, *commanded, {}, options);
  if (!trial) return trial.error();
  const auto read =
      part_readings(job->machine, setup->errors, job->piece, *trial->workpiece, *plan, probe);
  if (!read) return read.error();
  PartFindings found{.readings = instruments::shown(setup->instrument, read->values, 0),
                     .on_cmm = trial->measurement,
                     .at = read->at};
  if (!words.measured.empty()) {
    auto measured = read_part_log(words.measured, job->machine, job->piece, *plan);
    if (!measured) return measured.error();
    found.readings = *std::move(measured);
    found.log = words.measured;
  }
  auto measurement = part_measurement(job->piece, *plan, found.readings);
  if (!measurement) return measurement.error();
  found.on_machine = *std::move(measurement);
  const auto spans = trials::error_spans(job->piece, *commanded);
  if (!spans) return spans.error();
  const auto parameters = trials::part_parameters(job->machine, *spans);
  if (!parameters) return parameters.error();
  // What an error does to a part does not hang on masses and springs.
  auto gains = part_gains(job->machine, job->piece, *commanded, *plan, probe, *parameters,
                          {.path_bound = job->path_bound});
  if (!gains) return gains.error();
  found.gains = *std::move(gains);

  MotionAnswer answer =
      answer_of("probe", setup->words("The part probed where it was cut"), *setup);
  for (const Diagnostic& each : trial->wrong_cuts) answer.warnings.push_back(each);
  for (const Diagnostic& each : read->warnings) answer.warnings.push_back(each);
  answer.document["job"] = words.job;
  add_lobes(answer, *lobes);
  add_part_findings(answer, *job, *plan, found);
  if (!words.measured.empty()) {
    answer.files.erase("touches.csv");  // is what was given
    for (Diagnostic& each : touches_apart(job->piece, *plan, found.readings)) {
      each.file = words.measured;
      answer.warnings.push_back(std::move(each));
    }
  }
  if (const auto program = part_program(job->machine, job->piece, *plan)) {
    add_probing_programs(answer, *program);
  } else {
    for (const Diagnostic& each : program.error()) {
      answer.warnings.push_back(warning(each.id, each.message, each.hint));
    }
  }
  return answer;
}

}  // namespace frustum::app
