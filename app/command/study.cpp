// frustum study: what many machines make.
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/command/command_line.hpp"
#include "app/command/commands.hpp"
#include "app/command/option/style_option.hpp"
#include "app/study/study_json.hpp"
#include "app/study/study_report.hpp"
#include "app/study/study_run.hpp"
#include "app/study/study_statistics.hpp"
#include "core/counted.hpp"
#include "core/file_set.hpp"
#include "core/program_version.hpp"
#include "core/whole_file.hpp"

namespace frustum::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

struct StudyOptions : AnswerOptions {
  std::string file{};
  StudyWords words{};
  std::string out{};
  bool resume = false;
  std::string part{};
  std::vector<std::string> merge{};
  std::string csv{};
  StyleWords style{};
};

// More than this is said before it starts.
constexpr double kLongSeconds = 600.0;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Samples go to --out, else beside the study, into a folder of its name.
fs::path folder_of(const StudyOptions& options) {
  if (!options.out.empty()) return options.out;
  const fs::path file = options.file;
  return file.parent_path() / (file.stem().string() + ".out");
}

std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t number = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec != std::errc{} || read.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

Result<StudyWork> work_of(const StudyOptions& options, const StudyFile& study) {
  StudyWork work{.folder = folder_of(options), .resume = options.resume};
  for (const std::string& folder : options.merge) work.merge.emplace_back(folder);
  if (options.part.empty()) return work;
  const std::string_view text = options.part;
  const std::size_t slash = text.find('/');
  const auto k = number_in(text.substr(0, slash));
  const auto n = slash == std::string_view::npos ? std::nullopt : number_in(text.substr(slash + 1));
  if (!k || !n || *k < 1 || *k > *n) {
    return error("out-of-range"_id, fmt::format("--part {}: expected K/N", options.part),
                 "--part 2/8 is the second of eight parts");
  }
  if (!work.merge.empty()) {
    return error("given-twice"_id, "--part computes one part, --merge puts all of them together");
  }
  if (*n > 1 && !study.questions.stop.empty()) {
    return error("stop-rule"_id, "a part of a study cannot decide when all of it has enough draws",
                 "leave [stop] out, or use MPI, where the ranks share what they know");
  }
  work.job = *k - 1;
  work.jobs = *n;
  return work;
}

bool has_launcher() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

Result<studies::Ranks> launched_ranks() {
  if (!has_launcher()) return studies::Ranks();
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  const fs::path modules[] = {program / "frustum_mpi.so",
                              program.parent_path() / FRUSTUM_INSTALLED_MODULES / "frustum_mpi.so"};
  return studies::Ranks::launched(modules);
}

std::string duration_text(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

// How a study was run, which its result does not depend on.
std::string run_json(const StudyEnd& end, const studies::Ranks& ranks, double seconds) {
  char host[256] = {};
  (void)::gethostname(host, sizeof host - 1);
  const auto threads =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const auto time = std::chrono::duration_cast<std::chrono::seconds>(
      std::chrono::system_clock::now().time_since_epoch());
  const ordered_json doc{{"schema", "frustum/study-run/1"},
                         {"version", program_version()},
                         {"host", host},
                         {"threads", threads},
                         {"ranks", ranks.count()},
                         {"seconds", seconds},
                         {"draws_computed", end.computed},
                         {"ended_unix_s", time.count()}};
  return doc.dump(1) + "\n";
}

class StudyCommand {
 public:
  StudyCommand(const StudyOptions& options, const StudyFile& study, const StudyModel& model,
               const studies::Ranks& ranks)
      : options_(options),
        study_(study),
        model_(model),
        ranks_(ranks),
        words_(style_of(options.style)),
        started_(now()) {}

  // The exit code of this rank.
  int run() {
    report::Progress progress(
        std::cerr, ranks_.is_first() ? progress_style(options_) : report::ProgressStyle::silent);
    if (study_.engine != studies::EngineKind::full) progress.begin("control the linear engine");
    auto engine = choose_engine(study_, model_, [&](double share) { progress.at(share); });
    progress.end();
    if (!engine) return refuse_at_file(engine.error());
    const auto mark = fingerprint_of(study_, model_, engine->kind);
    if (!mark) return refuse(mark.error(), options_);
    const auto work = work_of(options_, study_);
    if (!work) return refuse(work.error(), options_);
    std::optional<FileSet> set;
    if (ranks_.is_first()) {
      auto opened = FileSet::open(work->folder, {"result.json", "run.json", "report.html"});
      if (opened) set = *std::move(opened);
      (void)ranks_.sum(opened ? 0 : 1);
      if (!opened) return refuse(opened.error(), options_);
    } else if (ranks_.sum(0) > 0) {
      return kBadInput;
    }
    StudyRun run(study_, model_, *engine, ranks_, {*mark, study_.seed});
    const Interruption interruption;  // Stands before Ctrl-C is announced.
    if (work->merge.empty()) announce(run, *work, engine->result.name);
    drawing_since_ = now();
    progress.begin("draw " + counted(study_.samples, "machine"));
    const auto end =
        run.run(*work, interruption, [&](const StudyProgress& state) { show(progress, state); });
    progress.end();
    if (!end) return refuse(end.error(), options_);
    if (end->interrupted) return interrupted(*end, interruption);
    if (!ranks_.is_first()) return kDone;
    if (work->jobs > 1) return part_done(*work);
    return finish(run, *engine, *end, *set);
  }

 private:
  int refuse_at_file(Diagnostics problems) const {
    for (Diagnostic& d : problems) {
      if (d.file.empty()) d.file = options_.file;
    }
    return refuse(problems, options_);
  }

  void announce(const StudyRun& run, const StudyWork& work, const std::string& engine) const {
    if (!ranks_.is_first() || options_.quiet) return;
    const auto seconds = run.estimate(work);
    if (!seconds || *seconds < kLongSeconds) return;
    std::cerr << fmt::format(
        "frustum study: about {} to come ({}, engine {}); Ctrl-C ends it in good order, "
        "--resume goes on\n",
        duration_text(*seconds), counted(study_.samples, "draw"), engine);
  }

  void show(report::Progress& progress, const StudyProgress& state) const {
    if (state.end == 0) return;
    const double share = static_cast<double>(state.done) / static_cast<double>(state.end);
    const double seconds = now() - drawing_since_;
    progress.rename(fmt::format("{} of {} draws, {:.0f}/s{}", state.done, state.end,
                                static_cast<double>(state.done) / std::max(seconds, 1e-3),
                                state.first.empty() ? "" : ", " + state.first));
    progress.at(share);
  }

  int interrupted(const StudyEnd& end, const Interruption& interruption) const {
    if (ranks_.is_first() && !options_.quiet) {
      std::cerr << fmt::format(
          "frustum study: interrupted; {} of this run on disk; "
          "--resume goes on\n",
          counted(end.computed, "draw"));
    }
    // Another rank may be the one that was interrupted.
    constexpr int kInterrupted = 130;
    return interruption.has_come() ? interruption.exit_code() : kInterrupted;
  }

  int part_done(const StudyWork& work) const {
    if (!options_.quiet && !options_.json) {
      std::cout << fmt::format("part {} of {} is in {}; --merge puts all parts together\n",
                               work.job + 1, work.jobs, work.folder.string());
    }
    return kDone;
  }

  int finish(const StudyRun& run, const ChosenEngine& engine, const StudyEnd& end, FileSet& set) {
    const auto columns = run.columns(end.samples);
    if (!columns) return refuse(columns.error(), options_);
    const auto result = result_of(study_, model_, engine, *columns, end.samples);
    if (!result) return refuse_at_file(result.error());
    const std::string json = study_json(*result);
    set.add("result.json", json);
    set.add("run.json", run_json(end, ranks_, now() - started_));
    set.add("report.html", study_report(study_, model_, *result, *columns, words_));
    if (const auto written = set.write(); !written) return refuse(written.error(), options_);
    if (!options_.csv.empty()) {
      const auto written = write_samples_csv(run.folder(), end.samples, options_.csv);
      if (!written) return refuse(written.error(), options_);
    }
    if (options_.json) {
      std::cout << json;
    } else if (!options_.quiet) {
      std::cout << study_text(*result, words_);
    }
    for (const std::string& what : result->not_reached) {
      if (!options_.quiet) std::cerr << "frustum study: not reached: " << what << '\n';
    }
    return result->not_reached.empty() ? kDone : kOutOfTolerance;
  }

  const StudyOptions& options_;
  const StudyFile& study_;
  const StudyModel& model_;
  const studies::Ranks& ranks_;
  report::Wording words_;
  double started_;
  double drawing_since_ = 0.0;
};

int run_study(const StudyOptions& options) {
  const auto ranks = launched_ranks();
  if (!ranks) return refuse(ranks.error(), options);
  const auto study = load_study_file(options.file, options.words);
  if (!study) return refuse(study.error(), options);
  if (!options.csv.empty()) {
    if (auto problem = unwritable(options.csv)) return refuse(*problem, options);
  }
  auto model = make_model(*study);
  if (!model) {
    Diagnostics problems = std::move(model).error();
    for (Diagnostic& d : problems) {
      if (d.file.empty()) d.file = options.file;
    }
    return refuse(problems, options);
  }
  if (const auto problems = unanswerable(*study, **model); !problems.empty()) {
    return refuse(problems, options);
  }
  return StudyCommand(options, *study, **model, *ranks).run();
}

}  // namespace

void add_study(Command& program) {
  auto o = std::make_shared<StudyOptions>();
  Command command = program.command(
      "study", "Many machines, drawn from the laws of their errors: what they make");
  command.option("file", o->file, "Study file, or a job file, which is a study with the defaults")
      .required();
  command.option("--samples,--draws", o->words.samples, "Machines to draw (default: the study's)");
  command.option("--seed", o->words.seed, "Of the draws; the same seed gives the same machines");
  command.option("--scheme", o->words.scheme, "random, latin or sobol");
  command.option("--engine", o->words.engine,
                 "auto, linear (first order) or full (every machine cuts and is measured)");
  command.option("--out", o->out,
                 "Folder for result.json, report.html and samples/ (default: beside the study, "
                 "NAME.out)");
  command.flag("--resume", o->resume, "Keep the samples that are there and go on");
  command.option("--part", o->part, "K/N: compute the K-th of N parts only, as a job of an array");
  command.option("--merge", o->merge, "Folders of parts: put their samples together");
  command.option("--stop", o->words.stop,
                 "\"CHARACTERISTIC q50=0.05um\", repeated: stop when its interval is so narrow");
  command.option("--csv", o->csv, "File for a row a draw");
  command.option("--error", o->words.errors.errors,
                 "NAME=VALUE, repeated; overrides the study, for example --error EB0C=30urad");
  command.option("--errors", o->words.errors.files,
                 "Error file, or the name of a shipped one; repeated; overrides the study");
  add_style_options(command, o->style);
  add_answer_options(command, *o);
  command.footer(
      "Exit code 1: fewer parts conform than at_least says, or a stop rule is not reached; 130: "
      "interrupted, to be resumed.\n"
      "Example: frustum study examples/bossoni-study/proposed-r.toml --samples 1000 --out study");
  command.computes([o] { return run_study(*o); });
}

}  // namespace frustum::app
