// frustum measure: the virtual CMM on a job's part or on a mesh, or the evaluation of real CMM
// points.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/command/cmm_option.hpp"
#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/command/option/style_option.hpp"
#include "app/command/unit_option.hpp"
#include "app/job/export_request.hpp"
#include "app/job/job.hpp"
#include "app/job/job_evidence.hpp"
#include "app/job/job_report.hpp"
#include "app/job/plan_export.hpp"
#include "app/job/program_files.hpp"
#include "app/job/trial_run.hpp"
#include "app/view/console.hpp"
#include "core/file_set.hpp"
#include "core/whole_file.hpp"
#include "metrology/plan/point_scale.hpp"
#include "metrology/plan/qif/qif_plan.hpp"
#include "metrology/points/point_file.hpp"
#include "metrology/uncertainty/point_uncertainty.hpp"
#include "report/exchange/json_report.hpp"
#include "report/exchange/points_csv.hpp"
#include "report/measuring_statement.hpp"
#include "report/page/html_report.hpp"
#include "trials/mesh_probe.hpp"

namespace frustum::app {
namespace {

using metrology::CmmModel;
using metrology::InspectionPlan;
using metrology::LengthUnit;

struct MeasureOptions : ResultOptions {
  std::string job{};
  std::string plan{};
  std::string plan_export{};
  std::string points{};
  std::string mesh{};
  std::string unit{};
  std::string out{};
  StyleWords style{};
  CmmWords cmm{};
  JobOverrides overrides{};
  bool ball_centres = false;
};

int conflicting(const MeasureOptions& options, std::string message, std::string hint) {
  return refuse(error("conflicting-options"_id, std::move(message), std::move(hint)), options);
}

// The files of --out; nothing where none are asked for.
using OutSet = std::optional<FileSet>;

Result<OutSet> out_set(const MeasureOptions& options) {
  if (options.out.empty()) return OutSet{};
  auto set = FileSet::open(options.out, {"result.json", "points.csv", "report.html"});
  if (!set) return set.error();
  return OutSet{*std::move(set)};
}

Diagnostics write_files(OutSet& set, report::RunReport& report, const InspectionPlan& plan,
                        const std::vector<std::filesystem::path>& exports) {
  if (!set) return write_exports(exports, report, plan);
  const auto add = [&](const char* name, std::string bytes) {
    report.files.push_back(set->add(name, std::move(bytes)).string());
  };
  add("result.json", report::json_report(report));
  add("points.csv", report::points_csv(report.measurement, plan));
  add("report.html", report::html_report(report));
  if (auto faults = write_exports(exports, report, plan, &*set); !faults.empty()) return faults;
  const auto written = set->write();
  return written ? Diagnostics{} : written.error();
}

int write_and_show(OutSet& set, report::RunReport& report, const InspectionPlan& plan,
                   const std::vector<std::filesystem::path>& exports,
                   const MeasureOptions& options) {
  const Diagnostics faults = write_files(set, report, plan, exports);
  return faults.empty() ? show_result(report, options) : refuse(faults, options);
}

int measure_job(const MeasureOptions& options) {
  const auto job = load_job(options.job, options.overrides, true);
  if (!job) return refuse(job.error(), options);
  const auto exports = checked_exports(options.exports, job->exports);
  if (!exports) return refuse(exports.error(), options);
  auto set = out_set(options);
  if (!set) return refuse(set.error(), options);
  auto evidence = evidence_of(*job);
  if (!evidence) return refuse(evidence.error(), options);
  TrialRun run(progress_style(options));
  const auto trial = run.trial(*job);
  if (!trial) {
    write_failed_exports(*exports, trial.error(), job->piece.plan);
    return refuse(trial.error(), options);
  }
  const report::ReportStyle style = style_of(options.style);
  evidence->measuring_shown = report::measuring_statement(
      job->piece.plan, job->cmm, report::PointSource::virtual_cmm, report::Wording(style));
  report::RunReport report = report_of(*job, *trial, *std::move(evidence));
  report.style = style;
  report.timings = run.timings();
  return write_and_show(*set, report, job->piece.plan, *exports, options);
}

// What every U of points or a mesh lacks, as nothing else is known of the machine that measured
// them.
std::optional<Diagnostic> missing_accuracy(const CmmModel& cmm) {
  constexpr const char* kState =
      "state its accuracy with --e0 \"1.8 um\" --l-per-um 350, or --cmm FILE";
  Diagnostic missing;
  if (metrology::point_uncertainty(cmm).is_zero()) {
    missing = warning("unknown-accuracy"_id,
                      "nothing is known of the machine that measured: uncertainties are 0", kState);
  } else if (!cmm.length_per_error) {
    missing = warning("unknown-accuracy"_id,
                      "how the errors of the machine that measured grow with length (l_per_um) is "
                      "not stated: no U contains that",
                      kState);
  } else if (cmm.e0_mm == 0.0 && !cmm.probe) {
    missing =
        warning("unknown-accuracy"_id,
                "the error of a single point (e0) of the machine that measured is not stated: no "
                "U contains it",
                kState);
  } else {
    return std::nullopt;
  }
  missing.severity = Severity::note;
  return missing;
}

Result<metrology::Measurement> evaluated_points(const MeasureOptions& options,
                                                const InspectionPlan& plan,
                                                const std::optional<LengthUnit>& unit,
                                                const CmmModel& cmm, std::string_view bytes,
                                                bool has_strategies) {
  const auto meaning = options.ball_centres ? metrology::PointMeaning::ball_centre
                                            : metrology::PointMeaning::surface;
  const auto points = metrology::parse_feature_points(bytes, options.points, unit, meaning);
  if (!points) return points.error();
  // Where a plan does not say where to touch, its size is not known.
  auto fault = has_strategies ? metrology::scale_fault(plan, *points) : std::nullopt;
  if (fault) {
    fault->file = options.points;
    return *std::move(fault);
  }
  auto measurement = metrology::evaluate(plan, *points, meaning, cmm);
  if (measurement) return measurement;
  Diagnostics faults = std::move(measurement).error();
  for (Diagnostic& d : faults) {
    if (d.file.empty()) d.file = options.points;
  }
  return faults;
}

Result<metrology::Measurement> probed_mesh(const MeasureOptions& options,
                                           const InspectionPlan& plan,
                                           const std::optional<LengthUnit>& unit,
                                           const CmmModel& cmm) {
  const auto probe = trials::read_mesh_probe(options.mesh, unit, plan);
  if (!probe) return probe.error();
  // An ideal machine would probe the mesh without error; how far that is from the part nobody says.
  auto measurement = metrology::measure(plan, *probe, cmm, metrology::NoErrors::unknown);
  if (measurement && probe->note()) measurement->diagnostics.push_back(*probe->note());
  if (measurement) return measurement;
  Diagnostics faults = measurement.error();
  if (auto facing = probe->facing_fault(plan)) faults.insert(faults.begin(), *std::move(facing));
  for (Diagnostic& d : faults) {
    if (d.file.empty()) d.file = options.mesh;
  }
  return faults;
}

// What was read, which a pipe would not give again.
struct ReadFiles {
  std::string plan{};
  std::string points{};
};

Result<report::Evidence> evidence_of(const MeasureOptions& options, const InspectionPlan& plan,
                                     const CmmModel& cmm, const ReadFiles& read) {
  report::Evidence evidence;
  evidence.header = plan.header;
  const bool is_probed = !options.mesh.empty();
  const auto source = is_probed ? report::PointSource::mesh : report::PointSource::measured_points;
  evidence.measuring = report::measuring_statement(plan, cmm, source);
  evidence.measuring_shown =
      report::measuring_statement(plan, cmm, source, report::Wording(style_of(options.style)));
  evidence.files.push_back(report::hashed_file("plan", options.plan, read.plan));
  if (!is_probed) {
    evidence.files.push_back(report::hashed_file("points", options.points, read.points));
  }
  const std::pair<const char*, const std::string&> files[] = {{"mesh", options.mesh},
                                                              {"cmm", options.cmm.file}};
  for (const auto& [role, file] : files) {
    const Diagnostics problems = add_hash(evidence.files, role, file);
    if (!problems.empty()) return problems;
  }
  return evidence;
}

// Only points of surfaces can do without what a plan does not say of its probing. What is written
// says it.
Result<metrology::ReadPlan> plan_of(const MeasureOptions& options, const std::string& bytes) {
  const bool is_probing =
      !options.mesh.empty() || options.ball_centres || !options.plan_export.empty();
  if (!is_probing) return metrology::parse_plan_for_points(bytes, options.plan);
  auto plan = metrology::parse_plan(bytes, options.plan);
  if (!plan) return std::move(plan).error();
  return metrology::ReadPlan{*std::move(plan), {}};
}

int measure_by_plan(const MeasureOptions& options) {
  ReadFiles read;
  auto bytes = read_whole_file(options.plan);
  if (!bytes) return refuse(bytes.error(), options);
  read.plan = *std::move(bytes);
  const auto planned = plan_of(options, read.plan);
  if (!planned) return refuse(planned.error(), options);
  const InspectionPlan* const plan = &planned->plan;
  if (!options.plan_export.empty()) {
    const Diagnostics faults = write_plan(options.plan_export, *plan);
    if (!faults.empty()) return refuse(faults, options);
    if (options.points.empty() && options.mesh.empty()) return kDone;
  }
  const auto unit = unit_of(options.unit);
  if (!unit) return refuse(unit.error(), options);
  const auto cmm = cmm_of(options.cmm);
  if (!cmm) return refuse(cmm.error(), options);
  const auto exports = checked_exports(options.exports);
  if (!exports) return refuse(exports.error(), options);
  auto set = out_set(options);
  if (!set) return refuse(set.error(), options);
  auto measurement =
      with_progress(options, "measure", [&](report::Progress&) -> Result<metrology::Measurement> {
        if (!options.mesh.empty()) return probed_mesh(options, *plan, *unit, *cmm);
        auto points = metrology::read_point_bytes(options.points);
        if (!points) return std::move(points).error();
        read.points = *std::move(points);
        return evaluated_points(options, *plan, *unit, *cmm, read.points,
                                planned->warnings.empty());
      });
  if (!measurement) {
    write_failed_exports(*exports, measurement.error(), *plan);
    return refuse(measurement.error(), options);
  }
  measurement->diagnostics.insert(measurement->diagnostics.begin(), planned->warnings.begin(),
                                  planned->warnings.end());
  if (auto missing = missing_accuracy(*cmm)) {
    measurement->diagnostics.push_back(*std::move(missing));
  }
  auto evidence = evidence_of(options, *plan, *cmm, read);
  if (!evidence) return refuse(evidence.error(), options);
  report::RunReport report;
  const std::string& source = options.mesh.empty() ? options.points : options.mesh;
  report.title =
      plan->title.empty() ? std::filesystem::path(source).filename().string() : plan->title;
  report.version = FRUSTUM_VERSION;
  report.style = style_of(options.style);
  report.evidence = *std::move(evidence);
  report.measurement = *std::move(measurement);
  return write_and_show(*set, report, *plan, *exports, options);
}

int measure(const MeasureOptions& options) {
  const int sources = int{!options.points.empty()} + int{!options.mesh.empty()};
  const bool by_plan = options.job.empty() && !options.plan.empty() &&
                       (sources == 1 || (sources == 0 && !options.plan_export.empty()));
  const bool by_job = !options.job.empty() && options.plan.empty() && sources == 0;
  if (!by_plan && !options.plan_export.empty()) {
    return conflicting(options, "--export-plan goes with --plan",
                       "frustum measure --plan PLAN.toml --export-plan PLAN.qif");
  }
  for (const std::string& file : options.exports) {
    if (!is_same_file(file, options.plan_export)) continue;
    return conflicting(options, fmt::format("--export-plan and --export write {}", file),
                       "choose another name for one of them");
  }
  if (by_plan && sources == 0 && (options.json || !options.exports.empty())) {
    return conflicting(options, "--json and --export need --points or --mesh",
                       "without them there is no result");
  }
  if (by_plan && options.overrides.any()) {
    return conflicting(options, "--error, --errors, --tool-radius-error and --draw go with a job",
                       "measured points and meshes have the errors that they have");
  }
  if (options.ball_centres && options.points.empty()) {
    return conflicting(options, "--ball-centres goes with --points", "leave it out");
  }
  if (by_job && !options.unit.empty()) {
    return conflicting(options, "--unit goes with --points or --mesh",
                       "a job's part is in mm; leave it out");
  }
  if (by_plan) return measure_by_plan(options);
  if (by_job && options.cmm.any()) {
    return conflicting(options, "--e0, --l-per-um and --cmm go with --points or --mesh",
                       "a job states its machine in [inspection.cmm]");
  }
  if (by_job) return measure_job(options);
  return conflicting(
      options, "give either a job file, or --plan and --points, or --plan and --mesh",
      "frustum measure job.toml | frustum measure --plan PLAN.toml --points POINTS.csv | "
      "frustum measure --plan PLAN.toml --mesh SCAN.stl");
}

}  // namespace

void add_measure(Command& program) {
  auto options = std::make_shared<MeasureOptions>();
  Command command = program.command(
      "measure",
      "Measure a job's part or a mesh on the virtual CMM, or evaluate points of a real CMM");
  command.option("job", options->job, "Job file");
  command.option("--plan", options->plan,
                 "Inspection plan for --points or --mesh, TOML or QIF 3.0");
  command.option("--export-plan", options->plan_export,
                 "The plan in another form, by the extension: .qif (QIF 3.0) or .toml; needs "
                 "neither points nor mesh");
  command.option("--points", options->points,
                 "CSV with feature,section,x,y,z, a QIF, or columns x y z or a PLY for a plan of "
                 "one feature; mm unless the file states a unit");
  command.option("--mesh", options->mesh,
                 "STL, PLY or OBJ that is probed like a part, in the plan's frame");
  add_unit_option(command, options->unit);
  add_cmm_options(command, options->cmm);
  command.flag("--ball-centres", options->ball_centres,
               "The points are centres of the probe ball, not surface points");
  add_error_options(command, options->overrides.errors);
  command.option("--tool-radius-error", options->overrides.tool_radius_error, "With unit");
  command.option("--out", options->out, "Folder for report.html, result.json and points.csv");
  add_style_options(command, options->style);
  add_result_options(command, *options);
  command.footer(
      "Example: frustum measure --plan cone.plan.toml --points out/points.csv --export part.qif "
      "--export part.junit.xml");
  command.computes([options] { return measure(*options); });
}

}  // namespace frustum::app
