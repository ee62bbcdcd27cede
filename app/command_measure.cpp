// frustum measure: the virtual CMM on a job's part, or the evaluation of real CMM points.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "app/console.hpp"
#include "app/job.hpp"
#include "app/job_report.hpp"
#include "app/trial_run.hpp"
#include "metrology/point_file.hpp"
#include "report/json_report.hpp"
#include "report/terminal_report.hpp"

namespace frustum::app {
namespace {

struct Options {
  std::string job{};
  std::string plan{};
  std::string points{};
  JobOverrides overrides{};
  bool ball_centres = false;
  bool json = false;
  bool quiet = false;
};

int print_report(const report::RunReport& report, const Options& options) {
  if (options.json) {
    std::cout << report::json_report(report);
  } else if (!options.quiet) {
    std::cout << report::terminal_report(report, {.colour = stdout_is_terminal()});
  }
  return report.passes() ? kDone : kOutOfTolerance;
}

int measure_job(const Options& options) {
  const auto job = load_job(options.job, options.overrides, true);
  if (!job) return refuse(job.error());
  TrialRun run(progress_style(options.quiet || options.json));
  const auto trial = run.trial(*job);
  if (!trial) return refuse(trial.error());
  report::RunReport report = report_of(*job, *trial);
  report.timings = run.timings();
  return print_report(report, options);
}

int evaluate_points(const Options& options) {
  const auto plan = metrology::load_plan(options.plan);
  if (!plan) return refuse(plan.error());
  const auto points = metrology::read_feature_points(options.points);
  if (!points) return refuse(points.error());
  const auto meaning = options.ball_centres ? metrology::PointMeaning::ball_centre
                                            : metrology::PointMeaning::surface;
  const auto measurement = metrology::evaluate(*plan, *points, meaning);
  if (!measurement) return refuse(measurement.error());
  report::RunReport report;
  report.title = plan->title;
  report.measurement = *measurement;
  return print_report(report, options);
}

int measure(const Options& options) {
  const bool points = !options.plan.empty() || !options.points.empty();
  if (points == !options.job.empty() || options.plan.empty() != options.points.empty()) {
    return refuse(
        "give either a job file, or --plan and --points",
        "frustum measure job.toml | frustum measure --plan PLAN.toml --points POINTS.csv");
  }
  return points ? evaluate_points(options) : measure_job(options);
}

}  // namespace

void add_measure(CLI::App& program, int& exit_code) {
  auto options = std::make_shared<Options>();
  CLI::App* command = program.add_subcommand(
      "measure", "Measure a job's part on the virtual CMM, or evaluate points of a real CMM");
  command->add_option("job", options->job, "Job file");
  command->add_option("--plan", options->plan, "Inspection plan for --points");
  command->add_option("--points", options->points, "CSV with feature,section,x,y,z (mm)");
  command->add_flag("--ball-centres", options->ball_centres,
                    "The points are centres of the probe ball, not surface points");
  add_error_options(*command, options->overrides.errors);
  command->add_option("--tool-radius-error", options->overrides.tool_radius_error, "With unit");
  command->add_flag("--json", options->json, "One JSON document on stdout and nothing else");
  command->add_flag("--quiet", options->quiet, "No progress, no summary");
  command->footer("Example: frustum measure --plan cone.plan.toml --points out/points.csv");
  command->callback([options, &exit_code] { exit_code = measure(*options); });
}

}  // namespace frustum::app
