// frustum sensitivity: derivatives of every characteristic of a job to machine errors.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/job.hpp"
#include "app/job/trial_run.hpp"
#include "app/view/console.hpp"
#include "app/view/sensitivity_view.hpp"
#include "core/file_set.hpp"
#include "trials/sensitivity.hpp"
#include "trials/trial.hpp"

namespace frustum::app {
namespace {

struct SensitivityOptions : AnswerOptions {
  std::string job{};
  std::string out{};
  std::string method = "analytic";
  std::vector<std::string> parameters{};
  std::optional<double> step_um{}, step_urad{};
  JobOverrides overrides{};
};

Result<trials::Sensitivity> derivatives(const SensitivityOptions& options, const Job& job) {
  const auto names =
      options.parameters.empty() ? trials::constant_errors(job.machine) : options.parameters;
  const auto parameters = trials::parameters_named(job.machine, names);
  if (!parameters) return parameters.error();
  const auto commanded = trials::command_piece(job.machine, job.piece);
  if (!commanded) return commanded.error();
  const auto errors = trials::errors_for(job.machine, job.errors, job.piece, *commanded);
  if (!errors) return errors.error();
  if (options.method == "analytic") {
    if (options.step_um || options.step_urad) {
      return error("conflicting-options"_id, "--step-um and --step-urad are steps of differences",
                   "add --method differences, or leave them out");
    }
    return trials::sensitivity(job.machine, *errors, job.piece, *commanded, *parameters,
                               path_options_of(job));
  }
  trials::DifferenceSteps steps;
  if (options.step_um) steps.length = *options.step_um / kUmPerMm;
  if (options.step_urad) steps.angle = *options.step_urad / kUradPerRad;
  return trials::sensitivity_by_differences(job.machine, *errors, job.piece, *parameters, steps,
                                            path_options_of(job));
}

int show_sensitivity(const SensitivityOptions& options) {
  const auto job = load_job(options.job, options.overrides, true);
  if (!job) return refuse(job.error(), options);
  std::optional<FileSet> set;
  if (!options.out.empty()) {
    auto opened =
        FileSet::open(options.out, {"sensitivity.json", "sensitivity.csv", "sensitivity.html"});
    if (!opened) return refuse(opened.error(), options);
    set = *std::move(opened);
  }
  const auto found = with_progress(options, "derive",
                                   [&](report::Progress&) { return derivatives(options, *job); });
  if (!found) return refuse(found.error(), options);
  const std::string method = options.method == "analytic" ? "analytic surface gains"
                                                          : "central differences of whole trials";
  const auto table = sensitivity_table(*found, job->piece.title, job->machine.title(), method);
  if (set) {
    set->add("sensitivity.json", report::sensitivity_json(table));
    set->add("sensitivity.csv", report::sensitivity_csv(table));
    set->add("sensitivity.html", report::sensitivity_html(table));
    if (const auto written = set->write(); !written) return refuse(written.error(), options);
  }
  if (options.json) {
    std::cout << report::sensitivity_json(table);
  } else if (!options.quiet) {
    std::cout << report::sensitivity_text(table, kTableWidth);
  }
  return kDone;
}

}  // namespace

void add_sensitivity(Command& program) {
  auto o = std::make_shared<SensitivityOptions>();
  Command command =
      program.command("sensitivity", "Derivative of every characteristic to every machine error");
  command.option("JOB", o->job, "Job file").required();
  command.option("--parameter", o->parameters,
                 "Machine error or tool_radius_error; repeat it (default: all constant ones)");
  command
      .option("--method", o->method, "analytic (one trial) or differences (two trials a parameter)")
      .one_of({"analytic", "differences"});
  command.option("--step-um", o->step_um, "differences: step of lengths, um (1)")
      .holds(positive_number(1000.0));
  command.option("--step-urad", o->step_urad, "differences: step of angles, urad (1)")
      .holds(positive_number(10000.0));
  add_error_options(command, o->overrides.errors);
  command.option("--tool-radius-error", o->overrides.tool_radius_error, "for example 2um");
  command.option("--out", o->out, "Folder for sensitivity.html, .csv and .json");
  add_answer_options(command, *o);
  command.footer("Example: frustum sensitivity job.toml --parameter beta_CA --parameter EX0C");
  command.computes([o] { return show_sensitivity(*o); });
}

}  // namespace frustum::app
