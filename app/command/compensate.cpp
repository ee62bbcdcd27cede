// frustum compensate: a job's program rewritten so that the actual tool follows the nominal path.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/job/compensated_job.hpp"
#include "app/job/job.hpp"
#include "app/job/trial_run.hpp"
#include "app/view/console.hpp"
#include "calibration/compensate/compensated_piece.hpp"
#include "core/file_set.hpp"
#include "core/made_by.hpp"
#include "core/program_version.hpp"
#include "trials/trial.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;

struct CompensateOptions : AnswerOptions {
  std::string job{};
  std::string out{};
  std::string dialect{};  // empty: the program's own
  JobOverrides overrides{};
  double bound = 0.02;  // um
};

// At most this is to be left, of the tip's error or in mm: the larger.
constexpr double kShareLeft = 0.01;
constexpr double kLeft = 5e-5;

nlohmann::ordered_json as_json(const calibration::PathError& error) {
  return {{"tip_um", error.tip * kUmPerMm}, {"axis_urad", error.axis * kUradPerRad}};
}

int report(const CompensateOptions& options, const calibration::CompensatedPiece& made,
           const std::vector<fs::path>& files) {
  const bool reached = made.after.tip <= std::max(kLeft, kShareLeft * made.before.tip);
  if (options.json) {
    nlohmann::ordered_json doc{{"schema", "frustum/compensate/1"},
                               {"version", program_version()},
                               {"files", nlohmann::ordered_json::array()},
                               {"before", as_json(made.before)},
                               {"after", as_json(made.after)},
                               {"at_turns", as_json(made.at_turns)},
                               {"reached", reached}};
    for (const fs::path& file : files) doc["files"].push_back(file.string());
    std::cout << doc.dump(2) << '\n';
  } else if (!options.quiet) {
    for (const fs::path& file : files) std::cout << file.string() << '\n';
    const auto row = [](const char* when, const calibration::PathError& error) {
      std::cout << fmt::format("{:<8} tip {:10.4f} um   tool axis {:10.4f} urad\n", when,
                               error.tip * kUmPerMm, error.axis * kUradPerRad);
    };
    row("before", made.before);
    row("after", made.after);
    if (made.at_turns.tip > 0.0 || made.at_turns.axis > 0.0) {
      row("at turns", made.at_turns);
    }
  }
  if (reached) return kDone;
  std::cerr << "more than 1 % of the tip's error, and more than 0.05 um, is left\n";
  return kOutOfTolerance;
}

// The job, the program and, as it is, the plan.
Result<std::vector<fs::path>> write_compensated(const Job& job, programs::TestPiece& piece,
                                                const fs::path& folder) {
  piece.title += ", compensated";
  piece.program_file = fs::path(piece.program_file).filename().string();
  const std::string plan =
      job.plan_file.empty() ? ""
                            : fs::path(piece.program_file).replace_extension(".plan.toml").string();
  auto text = compensated_job(job, piece, plan, folder);
  if (!text) return text.error();
  std::vector<std::pair<std::string, std::string>> contents{
      {"job.toml", "# " + made_by() + ", compensated\n" + *text},
      {piece.program_file, piece.program}};
  if (!plan.empty()) contents.emplace_back(plan, job.plan_text);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : contents) names.push_back(name);
  auto set = FileSet::open(folder, std::move(names));
  if (!set) return set.error();
  std::vector<fs::path> files;
  for (auto& [name, bytes] : contents) files.push_back(set->add(name, std::move(bytes)));
  if (const auto written = set->write(); !written) return written.error();
  return files;
}

// Lag alone makes the tool late, which is no error of its path.
trials::TrialOptions run_of(const Job& job) {
  trials::TrialOptions run = path_options_of(job);
  if (!run.has_dynamics()) run.servo_lag = false;
  return run;
}

int compensate(const CompensateOptions& options) {
  const auto job = load_job(options.job, options.overrides, false);
  if (!job) return refuse(job.error(), options);
  std::error_code ignored;
  if (fs::equivalent(job->file.parent_path().empty() ? "." : job->file.parent_path(), options.out,
                     ignored)) {
    return refuse(error("output-overwrites-input"_id, "the output would overwrite the job",
                        "choose another folder for --out"),
                  options);
  }
  if (const auto set = FileSet::open(options.out, {}); !set) return refuse(set.error(), options);
  const auto commanded = trials::command_piece(job->machine, job->piece);
  if (!commanded) return refuse(commanded.error(), options);
  const auto errors = trials::errors_for(job->machine, job->errors, job->piece, *commanded);
  if (!errors) return refuse(errors.error(), options);
  const auto dialect =
      options.dialect.empty() ? std::nullopt : parser::dialect_named(options.dialect);
  auto made = with_progress(options, "compensate", [&](report::Progress&) {
    return calibration::compensated_piece(job->machine, *errors, job->piece, *commanded,
                                          {.bound = options.bound / kUmPerMm, .run = run_of(*job)},
                                          dialect);
  });
  if (!made) return refuse(made.error(), options);
  const auto files = write_compensated(*job, made->piece, options.out);
  if (!files) return refuse(files.error(), options);
  return report(options, *made, *files);
}

}  // namespace

void add_compensate(Command& program) {
  auto o = std::make_shared<CompensateOptions>();
  Command command = program.command(
      "compensate", "Rewrite a job's program for the machine's errors, and prove it by running it");
  command.option("job", o->job, "Job file with the machine's errors").required();
  command.option("--out", o->out, "Folder for the compensated piece: job, program and plan")
      .required();
  command.option("--dialect", o->dialect, "Of the program written (default: its own)")
      .one_of({"fanuc", "iso", "linuxcnc", "sinumerik", "heidenhain"});
  add_error_options(command, o->overrides.errors);
  command
      .option("--bound", o->bound,
              "Actual against nominal path within a block, um (0.02); blocks are divided")
      .holds(positive_number(1e3));
  add_answer_options(command, *o);
  command.footer(
      "Exit code 1 when more than 1 % of the tip's error and more than 0.05 um is left.\n"
      "The job written has no [errors]: the machine's own are given again with --errors or "
      "--error.\n"
      "Example: frustum compensate piece/job.toml --errors machine.errors.toml --out compensated");
  command.computes([o] { return compensate(*o); });
}

}  // namespace frustum::app
