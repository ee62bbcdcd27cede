// frustum run: the whole loop, from a job file to a report.
#include <fmt/format.h>

#include <memory>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/command/option/style_option.hpp"
#include "app/job/export_request.hpp"
#include "app/job/job.hpp"
#include "app/job/job_evidence.hpp"
#include "app/job/job_report.hpp"
#include "app/job/trial_run.hpp"
#include "app/view/console.hpp"
#include "core/file_set.hpp"
#include "report/exchange/json_report.hpp"
#include "report/exchange/points_csv.hpp"
#include "report/measuring_statement.hpp"
#include "report/page/html_report.hpp"

namespace frustum::app {
namespace {

struct RunOptions : ResultOptions {
  std::string job{};
  std::string out{};
  JobOverrides overrides{};
  StyleWords style{};
};

// Files go to --out, else beside the job into out/.
std::filesystem::path folder_of(const RunOptions& options) {
  if (!options.out.empty()) return options.out;
  return std::filesystem::path(options.job).parent_path() / "out";
}

// Writes result.json, points.csv, the page, and the exports that are in their folder, as one; their
// names go into the report for the terminal.
Diagnostics write_files(FileSet& set, report::RunReport& report, const Job& job,
                        const std::vector<std::filesystem::path>& exports) {
  const auto add = [&](const char* name, std::string bytes) {
    report.files.push_back(set.add(name, std::move(bytes)).string());
  };
  add("result.json", report::json_report(report));
  add("points.csv", report::points_csv(report.measurement, job.piece.plan));
  if (job.report) add("report.html", report::html_report(report));
  if (auto faults = write_exports(exports, report, job.piece.plan, &set); !faults.empty()) {
    return faults;
  }
  const auto written = set.write();
  return written ? Diagnostics{} : written.error();
}

int run_job(const RunOptions& options) {
  const auto job = load_job(options.job, options.overrides, true);
  if (!job) return refuse(job.error(), options);
  const auto exports = checked_exports(options.exports, job->exports);
  if (!exports) return refuse(exports.error(), options);
  auto set = FileSet::open(folder_of(options), {"result.json", "points.csv", "report.html"});
  if (!set) return refuse(set.error(), options);
  auto evidence = evidence_of(*job);
  if (!evidence) return refuse(evidence.error(), options);
  TrialRun run(progress_style(options));
  auto trial = run.trial(*job);
  if (!trial) {
    write_failed_exports(*exports, trial.error(), job->piece.plan);
    return refuse(trial.error(), options);
  }
  const report::ReportStyle style = style_of(options.style);
  evidence->measuring_shown = report::measuring_statement(
      job->piece.plan, job->cmm, report::PointSource::virtual_cmm, report::Wording(style));
  report::RunReport report = report_of(*job, *trial, *std::move(evidence));
  report.style = style;
  run.begin("prove points");
  add_proof(report, trials::prove_points(*trial->workpiece, trial->measurement));
  if (job->report) {
    run.begin("mesh the surface");
    const auto surface = finished_surface(*job, stock::WorkpieceAt(*trial->workpiece), {});
    if (!surface) return refuse(surface.error(), options);
    report.surface = picture_of(surface->mesh, job->piece.plan);
    const double finished = stock::measure(surface->mesh).volume;
    const double blank = trial->workpiece->blank().volume();
    report.volumes = {blank, finished, removed_volume(blank, finished)};
  }
  run.end();
  report.timings = run.timings();
  run.begin("write the files");
  if (const auto faults = write_files(*set, report, *job, *exports); !faults.empty()) {
    return refuse(faults, options);
  }
  run.end();
  return show_result(report, options);
}

}  // namespace

void add_run(Command& program) {
  auto options = std::make_shared<RunOptions>();
  Command command =
      program.command("run", "The whole loop: parse, execute with errors, cut, measure, report");
  command.option("job", options->job, "Job file").required();
  command.option("--out", options->out,
                 "Folder for report.html, result.json and points.csv "
                 "(default: out/ beside the job)");
  add_error_options(command, options->overrides.errors);
  command.option("--tool-radius-error", options->overrides.tool_radius_error,
                 "Of every tool, with unit, for example 2um");
  add_style_options(command, options->style);
  add_result_options(command, *options);
  command.footer("Example: frustum run job.toml --out out --error EX0C=10um");
  command.computes([options] { return run_job(*options); });
}

}  // namespace frustum::app
